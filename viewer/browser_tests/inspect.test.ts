// SPDX-License-Identifier: Apache-2.0
import type {Page} from 'playwright-core';
import * as three from 'three';
import {afterAll, beforeAll, expect, test} from 'vitest';

import {ballPlace, close, colorAt, Place, ready, typeInto} from './browser';
import {Server} from './server';
import {visit} from './visit';

let server: Server;
const kInside = [0, 1.5, 0];   // the dark room: warm walls, a small window of sky
const kOutside = [0, 1.5, 8];  // the court: a blue sky above green ground

beforeAll(async () => {
    server = await new Server().start();
    const scene = await server.uploadCourtyard();
    await server.bake({scene, samples: 128, name: 'court', layers: ['sky', 'emission']});
});
afterAll(async () => {
    await close();
    await server?.end();
});

const link = (object: number[]) => `${server.url}/#tab=inspect&hidden=scene,probes,cells` +
    `&eye=0,14,4.01&target=0,0,4&object=${object.join(',')}`;

const positionOf = (page: Page) => page.evaluate(
    () => (window as unknown as {tetralight: {inspect: {ball: {position: number[]}}}}).tetralight.inspect.ball.position);

/** Where a position of the world is in the page. */
const placeOf = (page: Page, position: number[]) => page.evaluate(([x, y, z]) => {
    const {viewer, inspect} = (window as any).tetralight;  // eslint-disable-line
    return viewer.stage.pageFrom(inspect.object.ball.position.clone().set(x, y, z)) as Place;
}, position);

test('dragged from the dark room into the lit court, the ball turns from warm to blue', () => visit(link(kInside), async page => {
    await ready(page);
    const start = await ballPlace(page);
    const [warmRed, warmGreen, warmBlue] = await colorAt(page, start);
    const end = await placeOf(page, kOutside);
    await page.mouse.move(start.x, start.y);
    await page.mouse.down();
    await page.mouse.move(end.x, end.y, {steps: 10});
    await page.mouse.up();
    await expect.poll(async () => (await positionOf(page))[2]).toBeCloseTo(kOutside[2], 0);
    const position = await positionOf(page);
    position.forEach((value, axis) => expect(value).toBeCloseTo(kOutside[axis], 0));
    const [coolRed, coolGreen, coolBlue] = await colorAt(page, await ballPlace(page));
    expect(warmRed).toBeGreaterThan(1.2 * warmBlue);
    expect(coolBlue).toBeGreaterThan(1.2 * coolRed);
    expect(coolRed + coolGreen + coolBlue).toBeGreaterThan(1.3 * (warmRed + warmGreen + warmBlue));
}));

test('the panel says the cell, its probes and weights that add up to 1', () => visit(link(kOutside), async page => {
    await ready(page);
    await page.getByText(/^Cell \d+$/).waitFor();
    const weights = await page.locator('.answer td.number').allTextContents();
    expect(weights).toHaveLength(4);
    expect(weights.reduce((sum, text) => sum + Number(text), 0)).toBeCloseTo(1, 2);
}));

test('what is not a number moves neither the ball nor the box', () => visit(link(kOutside), async page => {
    await ready(page);
    const sizeOf = () => page.evaluate(() => {
        const {inspect} = (window as any).tetralight;  // eslint-disable-line
        return inspect.crowd.box.group.scale.toArray() as number[];
    });
    const height = page.getByLabel('Position of the ball, metres y');
    const length = page.getByLabel('Size of the box, metres x');
    await page.getByLabel('Proxy volume for a large object').check();
    for (const text of ['', '-', '1e400', 'abc']) {
        await typeInto(height, text);
        expect(await height.inputValue(), text).toBe('1.5');
        expect(await positionOf(page), text).toEqual(kOutside);
    }
    for (const text of ['', '0', '-3']) {
        await typeInto(length, text);
        expect(await length.inputValue(), text).toBe('6');
        expect(await sizeOf(), text).toEqual([6, 1, 1]);
    }
    await typeInto(length, '4');
    expect(await sizeOf()).toEqual([4, 1, 1]);
}));

/** Positions in and outside the hull of the court's probes. */
const kPositions = [[0.2, 1.4, 0.1], [3.1, 2.2, 5.3], [-9.2, 4.1, -7.3], [61, 30, 11], [0.3, 8.1, -0.2]];

/** The difference over the largest coefficient. */
function difference(ours: number[], theirs: number[]): number {
    const size = Math.max(...theirs.map(Math.abs));
    return Math.max(...theirs.map((value, i) => Math.abs(value - ours[i]))) / size;
}

interface Answers {
    answers: {cell: number | null; irradiance_sh: number[][]}[];
}

test('the light in the page is the light that the server finds', () => visit(link(kOutside), async page => {
    await ready(page);
    const {id, found} = await page.evaluate(places => {
        const {viewer, inspect} = (window as any).tetralight;  // eslint-disable-line
        const found = places.map(place => {
            inspect.object.ball.position.set(...place);
            const {cell, sh} = inspect.object.query();
            return {cell: cell as number, sh: [...sh as Float32Array]};
        });
        return {id: viewer.volume.file.id as string, found};
    }, kPositions);
    const {answers} = await server.request<Answers>(
        'POST', `/v1/volumes/${id}/query`, JSON.stringify({positions: kPositions}));
    found.forEach(({cell, sh}, i) => {
        expect(cell).toBe(answers[i].cell);
        expect(difference(sh, answers[i].irradiance_sh.flat())).toBeLessThan(1e-5);
    });
}));

test('the mesh ball is lit by one query a frame, without the server', () => visit(link(kOutside), async page => {
    await ready(page);
    const paths: string[] = [];
    page.on('request', request => paths.push(new URL(request.url()).pathname));
    const light = () => page.evaluate(() => {
        const {inspect} = (window as any).tetralight;  // eslint-disable-line
        return [...inspect.crowd.ball.packed.array as Float32Array];
    });
    await page.getByLabel('1023 instances, one query a frame').check();
    await expect.poll(async () => Math.max(...await light())).toBeGreaterThan(0.1);
    const before = await light();
    expect(before).toHaveLength(28 * 1023);
    await expect.poll(light).not.toEqual(before);  // it turns
    await page.getByLabel('1023 instances, one query a frame').uncheck();
    expect(paths.filter(path => path !== '/readyz')).toEqual([]);
}));

/** The halves of the texture in a KTX 2.0 file with one level. */
function halvesOf(file: ArrayBuffer): Uint16Array {
    const view = new DataView(file);
    const [begin, size] = [80, 88].map(at => Number(view.getBigUint64(at, true)));
    return new Uint16Array(file.slice(begin, begin + size));
}

test("the block's texture is the one that the server makes", () => visit(link(kOutside), async page => {
    await ready(page);
    await page.getByLabel('Proxy volume for a large object').check();
    const {id, low, size, resolution, texels} = await page.evaluate(() => {
        const {viewer, inspect} = (window as any).tetralight;  // eslint-disable-line
        const {grid: {low, size, resolution}, field} = inspect.crowd.box;
        return {id: viewer.volume.file.id as string, low: low.toArray() as number[], size: size.toArray() as number[],
                resolution: resolution as number[], texels: [...field.uniforms.lppv.value.image.data as Uint16Array]};
    });
    const bounds = [...low, ...low.map((x, i) => x + size[i])];
    const answer = await fetch(`${server.url}/v1/lppv`, {
        method: 'POST', headers: {'Content-Type': 'application/json'},
        body: JSON.stringify({volume: id, bounds, resolution, format: 'ktx2', mode: 'full', precision: 'half'}),
    });
    const [ours, theirs] = [Uint16Array.from(texels), halvesOf(await answer.arrayBuffer())].map(
        halves => Array.from(halves, three.DataUtils.fromHalfFloat));
    expect(ours).toHaveLength(theirs.length);
    expect(difference(ours, theirs)).toBeLessThan(2 ** -10);
}));

test('a proxy volume lights a block, and follows the weights of layers', () => visit(link(kOutside), async page => {
    await ready(page);
    await page.getByLabel('Proxy volume for a large object').check();
    // From the room to the court: warm at one end, blue at the other.
    await page.getByLabel('Center of the box, metres x').fill('0');
    await page.getByLabel('Center of the box, metres z').fill('4');
    await page.getByLabel('Size of the box, metres x').fill('1');
    await page.getByLabel('Size of the box, metres z').fill('12');
    await page.keyboard.press('Tab');
    const topAt = async (z: number) => colorAt(page, await placeOf(page, [0.3, 2, z]));
    /** How much redder than blue the block's top is. */
    const warmth = ([red, , blue]: number[]) => red / blue;
    expect(warmth(await topAt(-1)) / warmth(await topAt(7))).toBeGreaterThan(1.3);
    await page.getByRole('tab', {name: 'View'}).click();
    for (const layer of ['sky', 'emission']) await page.getByLabel(layer, {exact: true}).fill('0');
    expect(Math.max(...await topAt(7))).toBeLessThan(20);
}));
