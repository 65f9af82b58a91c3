// SPDX-License-Identifier: Apache-2.0
// `./run bench viewer`: one JSON object a line, as the other benchmarks print them.
import {mkdtempSync, readFileSync, readdirSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {gzipSync} from 'node:zlib';
import {build} from 'vite';

import {ballPlace, close, newContext, open, ready} from '../browser_tests/browser';
import {kViewer, Server} from '../browser_tests/server';

const kRepeats = 7;

const sorted = (values: number[]) => [...values].sort((a, b) => a - b);
const median = (values: number[]) => sorted(values)[values.length >> 1];
const print = (figure: string, ours: number, unit: string, more: Record<string, unknown> = {}) =>
    console.log(JSON.stringify({figure, ours: Number(ours.toPrecision(4)), unit, ...more}));

/** What the page fetches when it opens; parts that are fetched when they are first used count in `all`. */
function bundle(): void {
    const page = readFileSync(join(kViewer, 'index.html'), 'utf8');
    const files = readdirSync(join(kViewer, 'assets')).filter(name => /\.(js|css)$/.test(name));
    const sizes = new Map(files.map(name => [name, gzipSync(readFileSync(join(kViewer, 'assets', name))).length / 1000]));
    const sum = (names: string[]) => names.reduce((total, name) => total + sizes.get(name)!, 0);
    print('viewer.bundle', sum(files.filter(name => page.includes(name))), 'kB, gzipped', {all: Number(sum(files).toPrecision(4))});
}

type Shown = {tetralight: {viewer: any; inspect: any}; firstPicture?: number};  // eslint-disable-line

/** Milliseconds from navigation until the page shows everything at full resolution, and until its first picture of
 * the scene. */
async function loadOnce(url: string): Promise<{full: number; first: number}> {
    const page = await (await newContext({width: 960, height: 540})).newPage();
    await page.addInitScript(() => {
        const shown = window as unknown as Shown;
        const watch = setInterval(() => {
            if (shown.tetralight === undefined) return;
            clearInterval(watch);
            const {stage} = shown.tetralight.viewer;
            const gl = stage.renderer.getContext();
            stage.drawn.push(() => {
                if (shown.firstPicture !== undefined || shown.tetralight.viewer.model === null) return;
                gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits for it
                shown.firstPicture = performance.timeOrigin + performance.now();
            });
        });
    });
    const begin = performance.timeOrigin + performance.now();
    await page.goto(url);
    await ready(page);
    const {first, full} = await page.evaluate(async () => {
        const {viewer: {stage}} = (window as unknown as Shown).tetralight;
        await new Promise(drawn => requestAnimationFrame(drawn));
        if (stage.scale < 1) stage.drawNow();
        const gl = stage.renderer.getContext();
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
        return {first: (window as unknown as Shown).firstPicture!, full: performance.timeOrigin + performance.now()};
    });
    await page.context().close();
    return {full: full - begin, first: first - begin};
}

/** The same for a plain page of three.js, whose picture has the same size. */
async function loadPlainly(url: string): Promise<number> {
    const page = await (await newContext({width: 960, height: 540})).newPage();
    const begin = performance.now();
    await page.goto(url);
    await ready(page);
    await page.evaluate(() => {
        const gl = (window as any).renderer.getContext();  // eslint-disable-line
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    });
    await page.context().close();
    return performance.now() - begin;
}

async function buildPlainPage(folder: string): Promise<void> {
    await build({
        root: fileURLToPath(new URL('baseline', import.meta.url)), configFile: false, logLevel: 'warn',
        build: {outDir: folder, emptyOutDir: true, target: 'es2022', modulePreload: {polyfill: false},
                chunkSizeWarningLimit: 1500},
    });
}

/** A scene with its volume, against the same scene alone in a plain page. */
async function load(server: Server, plain: Server, name: string, scene: string): Promise<void> {
    const page = await open(`${server.url}/#volume=${name}`, {width: 960, height: 540});
    const plainLink = await page.evaluate(() => {
        const {viewer: {stage}} = (window as unknown as Shown).tetralight;
        const {clientWidth, clientHeight} = stage.parent;
        return `size=${clientWidth},${clientHeight}&eye=${stage.camera.position.toArray()}` +
            `&target=${stage.controls.target.toArray()}`;
    });
    await page.context().close();
    const [ours, first, theirs]: number[][] = [[], [], []];
    for (let i = 0; i < kRepeats; ++i) {
        const times = await loadOnce(`${server.url}/#volume=${name}`);
        ours.push(times.full / 1000);
        first.push(times.first / 1000);
        theirs.push(await loadPlainly(`${plain.url}/#scene=/v1/scenes/${scene}/file&${plainLink}`) / 1000);
    }
    const baseline = median(theirs);
    print(`viewer.load.${name}`, median(ours), 's', {
        baseline: Number(baseline.toPrecision(4)), ratio: Number((median(ours) / baseline).toPrecision(3)),
        baseline_is: 'the same scene in a plain page of three.js: GLTFLoader and an ambient light, without shadows',
    });
    print(`viewer.first_picture.${name}`, median(first), 's');
}

/** Each move of a hand: the query and the picture that follows, until it is drawn. */
async function drag(server: Server): Promise<void> {
    const view = '/#volume=courtyard&tab=inspect&eye=2.6,24,6.01&target=2.6,0,6&object=2.6,1.3,6';
    const page = await open(server.url + view, {width: 480, height: 320});
    const {x, y} = await ballPlace(page);
    await page.evaluate(() => {
        const {viewer: {stage}, inspect} = (window as unknown as Shown).tetralight;
        inspect.ball.times.length = 0;
        const gl = stage.renderer.getContext();
        const draw = stage.drawAt;
        const frames: number[] = [];
        stage.drawAt = function(scale: number) {
            const start = performance.now();
            draw.call(stage, scale);
            gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
            frames.push(performance.now() - start);
        };
        Object.assign(window, {frames});
    });
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let i = 0; i < 200; ++i) await page.mouse.move(x + 60 * Math.sin(i / 9), y + 40 * Math.sin(i / 7));
    const {frames, queries} = await page.evaluate(() => ({
        frames: (window as unknown as {frames: number[]}).frames.slice(),
        queries: (window as unknown as Shown).tetralight.inspect.ball.times as number[]}));
    await page.mouse.up();
    const p95 = (times: number[]) => sorted(times)[Math.floor(0.95 * times.length)];
    print('viewer.drag', p95(queries) + p95(frames), 'ms, p95 of a query and of a picture', {
        query: Number(p95(queries).toFixed(2)), picture: Number(p95(frames).toFixed(1)),
        queries: queries.length, pictures: frames.length,
    });
    await page.context().close();
}

/** The courtyard with 100 000 balls, against the courtyard without. */
async function manyProbes(server: Server): Promise<void> {
    const positions: number[][] = [];
    for (let i = 0; i < 100_000; ++i) positions.push([i % 50, 0.5 + Math.floor(i / 2500), Math.floor(i / 50) % 50]);
    const groups = await server.request<{id: string}>('POST', '/v1/groups',
                                                      JSON.stringify({groups: [{name: 'many', positions}]}));
    const {id} = await server.request<{id: string}>('POST', '/v1/tetrahedralize', JSON.stringify({groups: [groups.id]}));
    const page = await open(`${server.url}/#volume=${id}&scene=courtyard&hidden=cells`, {width: 480, height: 320});
    const [ours, baseline] = await page.evaluate(repeats => {
        const {stage, marks: {balls}} = (window as unknown as Shown).tetralight.viewer;
        const gl = stage.renderer.getContext();
        const frame = (isShown: boolean) => {
            balls.mesh.visible = isShown;
            const start = performance.now();
            stage.drawNow();
            gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits for it
            return performance.now() - start;
        };
        const times: number[][] = [[], []];
        for (let i = 0; i <= repeats; ++i) {
            const pair = [frame(true), frame(false)];
            if (i > 0) pair.forEach((time, k) => times[k].push(time));  // the first compiles shaders
        }
        return times;
    }, kRepeats);
    print('viewer.probes_100k', median(ours), 'ms a frame', {
        baseline: Number(median(baseline).toPrecision(4)),
        ratio: Number((median(ours) / median(baseline)).toPrecision(3)),
        baseline_is: 'the same frame without the balls',
    });
    await page.context().close();
}

const sceneAt = process.argv.indexOf('--scene');
const sceneFile = sceneAt < 0 ? null : process.argv[sceneAt + 1];
const server = await new Server().start();
const plainPage = mkdtempSync(join(tmpdir(), 'tetralight_plain_page_'));
await buildPlainPage(plainPage);
const plain = await new Server('', undefined, plainPage).start();
try {
    const scene = await server.uploadCourtyard();
    await plain.uploadCourtyard();
    await server.bake({scene, samples: 1024, name: 'courtyard'});
    bundle();
    await load(server, plain, 'courtyard', scene);
    if (sceneFile !== null) {
        const bytes = readFileSync(sceneFile);
        const {id} = await server.request<{id: string}>('POST', '/v1/scenes?name=scene', bytes);
        await plain.request('POST', '/v1/scenes?name=scene', bytes);
        const grid = await server.request<{id: string}>('POST', '/v1/grid', JSON.stringify({scene: id, spacing: 2.5}));
        await server.bake({scene: id, groups: [grid.id], sky: 1, samples: 64, name: 'scene'});
        await load(server, plain, 'scene', id);
    }
    await drag(server);
    await manyProbes(server);
} finally {
    await close();
    await server.end();
    await plain.end();
    rmSync(plainPage, {recursive: true, force: true});
}
