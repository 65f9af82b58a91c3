// SPDX-License-Identifier: Apache-2.0
// One ball that moves through a volume in four engines, beside pictures of `tetralight render`. The address names the
// volume: ?volume=URL. gallery.json lies beside it (make_input.ts).
import {read} from '../src/index.js';
import type {BallView, MakeBallView} from './ball_view.js';
import {makeBabylonBall} from './babylon_ball.js';
import {makeFilamentBall} from './filament_ball.js';
import type {Input} from './input.js';
import {makePlayCanvasBall} from './playcanvas_ball.js';
import {kOutline, kStations, placeInOverview, Position, positionOnRoad} from './road.js';
import {makeThreeBall} from './three_ball.js';
import {undoToneMapping} from './tone_mapping.js';

const kSize = 256;
const kSecondsOfRoad = 18;

/** For tests: mean bytes of the ball at each station, by row. */
export interface Gallery {
    names: string[];
    means: number[][][];
}

function makeCanvas(): HTMLCanvasElement {
    const canvas = document.createElement('canvas');
    canvas.width = canvas.height = kSize;
    // The ball without what is around it.
    canvas.style.clipPath = `circle(${50 * (kOutline - 0.01)}%)`;
    return canvas;
}

function makeCell(row: Element, kind: 'td' | 'th', ...content: (Node | string)[]): HTMLElement {
    const cell = document.createElement(kind);
    cell.append(...content);
    row.append(cell);
    return cell;
}

function note(cell: HTMLElement, text: string): void {
    const small = document.createElement('small');
    small.textContent = text;
    cell.append(small);
}

/** Mean bytes in a disc of nine tenths of the ball. */
function meanOf(context: CanvasRenderingContext2D): number[] {
    const {data} = context.getImageData(0, 0, kSize, kSize);
    const sums = [0, 0, 0];
    let count = 0;
    for (let i = 0; i < kSize * kSize; ++i) {
        const [x, y] = [i % kSize + 0.5 - kSize / 2, Math.floor(i / kSize) + 0.5 - kSize / 2];
        if (Math.hypot(x, y) > 0.9 * kOutline * kSize / 2) continue;
        ++count;
        for (let channel = 0; channel < 3; ++channel) sums[channel] += data[4 * i + channel];
    }
    return sums.map(sum => sum / count);
}

/** Canvases of one row: that of the moving ball, and those of the stations. */
class Row {
    readonly live = makeCanvas();
    readonly stations = kStations.map(() => makeCanvas().getContext('2d', {willReadFrequently: true})!);
    readonly head: HTMLElement;

    constructor() {
        const row = document.createElement('tr');
        document.querySelector('tbody')!.append(row);
        this.head = makeCell(row, 'th');
        makeCell(row, 'td', this.live);
        for (const {canvas} of this.stations) makeCell(row, 'td', canvas);
    }

    means(): number[][] {
        return this.stations.map(meanOf);
    }
}

async function addEngine(make: MakeBallView, volume: ArrayBuffer, exposure: number): Promise<[Row, BallView]> {
    const row = new Row();
    const view = await make(row.live, read(volume), exposure);
    row.head.append(view.name);
    // The first frames of an engine can lack what it still compiles.
    for (let i = 0; i < 5; ++i) await view.draw(kStations[0].position);
    for (const [i, {position}] of kStations.entries()) {
        await view.draw(position);
        row.stations[i].drawImage(row.live, 0, 0);
    }
    return [row, view];
}

/** Servers of single pages answer with the page where a file is missing. */
async function load(url: URL): Promise<Response> {
    const response = await fetch(url);
    if (response.ok && !response.headers.get('Content-Type')?.startsWith('text/html')) return response;
    throw new Error(`${url.href}: is not there (npm run gallery:input)`);
}

async function loadImage(url: URL): Promise<HTMLImageElement> {
    const image = new Image();
    image.src = url.href;
    await image.decode();
    return image;
}

/** Pictures of the command. Its ball jumps from station to station. */
async function addPictures(input: Input, base: URL): Promise<Row> {
    const row = new Row();
    row.head.append('tetralight render');
    note(row.head, 'by rays, without an engine');
    for (const [i, {picture}] of input.stations.entries()) {
        const context = row.stations[i];
        context.drawImage(await loadImage(new URL(picture, base)), 0, 0, kSize, kSize);
        const pixels = context.getImageData(0, 0, kSize, kSize);
        undoToneMapping(pixels.data);
        context.putImageData(pixels, 0, 0);
    }
    return row;
}

function addHeads(): void {
    const row = document.querySelector('thead tr')!;
    makeCell(row, 'th');
    makeCell(row, 'th', 'moving');
    kStations.forEach(({name}, i) => note(makeCell(row, 'th', String(i + 1)), name));
}

function mark(position: Position, text: string): HTMLElement {
    const element = document.createElement('div');
    element.className = 'mark';
    element.textContent = text;
    document.querySelector('figure')!.append(element);
    move(element, position);
    return element;
}

function move(element: HTMLElement, position: Position): void {
    const [x, y] = placeInOverview(position);
    element.style.left = `${100 * x}%`;
    element.style.top = `${100 * y}%`;
}

function noteDifferences(engines: readonly Row[], pictures: Row): void {
    const wanted = pictures.means();
    for (const row of engines) {
        const differences = row.means().flatMap((mean, i) => mean.map((value, k) => Math.abs(value - wanted[i][k])));
        note(row.head, `differs by ${Math.max(...differences).toFixed(1)} of 255`);
    }
}

async function animate(views: readonly BallView[], pictures: Row): Promise<void> {
    const now = mark(kStations[0].position, '');
    now.id = 'now';
    const shown = pictures.live.getContext('2d')!;
    for (;;) {
        const turn = performance.now() / 1000 / kSecondsOfRoad % 2;
        const share = turn < 1 ? turn : 2 - turn;
        const position = positionOnRoad(share);
        move(now, position);
        for (const view of views) await view.draw(position);
        shown.drawImage(pictures.stations[Math.round(share * (kStations.length - 1))].canvas, 0, 0);
        await new Promise(resolve => requestAnimationFrame(resolve));
    }
}

async function show(): Promise<void> {
    const parameters = new URLSearchParams(location.search);
    const url = new URL(parameters.get('volume') ?? 'court.probes', location.href);
    const bytes = await (await load(url)).arrayBuffer();
    const input = await (await load(new URL('gallery.json', url))).json() as Input;
    document.querySelector<HTMLImageElement>('#overview')!.src = new URL(input.overview, url).href;
    addHeads();
    kStations.forEach(({position}, i) => mark(position, String(i + 1)));
    const engines: [Row, BallView][] = [];
    for (const make of [makeThreeBall, makePlayCanvasBall, makeFilamentBall, makeBabylonBall]) {
        engines.push(await addEngine(make, bytes, input.exposure));
    }
    const pictures = await addPictures(input, url);
    const rows = [...engines.map(([row]) => row), pictures];
    noteDifferences(rows.slice(0, -1), pictures);
    const gallery: Gallery = {names: rows.map(({head}) => head.firstChild!.textContent!), means: rows.map(row => row.means())};
    Object.assign(window, {gallery});
    if (!parameters.has('still')) await animate(engines.map(([, view]) => view), pictures);
    pictures.live.getContext('2d')!.drawImage(pictures.stations[kStations.length - 1].canvas, 0, 0);
}

show().catch((error: unknown) => document.body.prepend(String(error)));
