// SPDX-License-Identifier: Apache-2.0
import type {Page} from 'playwright-core';
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

const link = (object: number[]) => `${server.url}/#tab=query&hidden=scene,probes,cells` +
    `&eye=0,14,4.01&target=0,0,4&object=${object.join(',')}`;

const positionOf = (page: Page) => page.evaluate(
    () => (window as unknown as {tetralight: {query: {position: number[]}}}).tetralight.query.position);

/** Where a position of the world is in the page. */
const placeOf = (page: Page, position: number[]) => page.evaluate(([x, y, z]) => {
    const {viewer, query} = (window as any).tetralight;  // eslint-disable-line
    return viewer.stage.pageFrom(query.object.ball.position.clone().set(x, y, z)) as Place;
}, position);

/** Waits until the server has answered for where the ball is now. */
async function answered(page: Page): Promise<void> {
    await page.waitForFunction(() => {
        const {query} = (window as unknown as {tetralight: {query: {newest: {isBusy: boolean}; roundTrips: number[]}}}).tetralight;
        return !query.newest.isBusy && query.roundTrips.length > 0;
    });
}

test('dragged from the dark room into the lit court, the ball turns from warm to blue', () => visit(link(kInside), async page => {
    await ready(page);
    await answered(page);
    const start = await ballPlace(page);
    const [warmRed, warmGreen, warmBlue] = await colorAt(page, start);
    const end = await placeOf(page, kOutside);
    await page.mouse.move(start.x, start.y);
    await page.mouse.down();
    await page.mouse.move(end.x, end.y, {steps: 10});
    await page.mouse.up();
    await expect.poll(async () => (await positionOf(page))[2]).toBeCloseTo(kOutside[2], 0);
    await answered(page);
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

test('what is no number moves neither the ball nor the box', () => visit(link(kOutside), async page => {
    await ready(page);
    await answered(page);
    const orders: string[] = [];
    page.on('request', request => {
        if (request.url().endsWith('/v1/lppv')) orders.push(request.postData()!);
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
    }
    await typeInto(length, '4');
    await expect.poll(() => orders.at(-1)).toContain('"bounds":[-2,');
    expect(orders).toHaveLength(2);
}));

test('light blended in the page is the light that the server interpolates', () => visit(link(kOutside), async page => {
    await ready(page);
    const largest = await page.evaluate(async () => {
        type Any = any;  // eslint-disable-line
        const {viewer, query} = (window as Any).tetralight;
        const own = query.object.constructor;
        let worst = 0;
        for (const place of [[0, 1.5, 0], [3, 2, 5], [-9, 4, -7], [60, 30, 10], [0.3, 8, -0.2]]) {
            query.object.ball.position.set(...place);
            const body = await viewer.api.query(viewer.volume.file.id, query.object.question);
            const served = own.prototype.show.call(query.object, body, viewer.volume, null).packed;
            const blended = query.object.show(body, viewer.volume, viewer.light).packed;
            const size = Math.max(...served.map(Math.abs));
            for (let i = 0; i < 28; ++i) worst = Math.max(worst, Math.abs(served[i] - blended[i]) / size);
        }
        return worst;
    });
    expect(largest).toBeLessThan(1e-5);
}));

test('the mesh ball is lit by one query a frame', () => visit(link(kOutside), async page => {
    await ready(page);
    await answered(page);
    const bodies: number[] = [];
    page.on('request', request => {
        if (request.url().endsWith('/query')) bodies.push(request.postDataBuffer()?.length ?? 0);
    });
    await page.getByLabel('1023 instances, one query a frame').check();
    await expect.poll(() => bodies.length).toBeGreaterThan(2);
    expect(new Set(bodies)).toEqual(new Set([16 + 1023 * 12]));
    const brightest = await page.evaluate(() => {
        const {query} = (window as any).tetralight;  // eslint-disable-line
        return Math.max(...query.ball.packed.array as Float32Array);
    });
    expect(brightest).toBeGreaterThan(0.1);
    await page.getByLabel('1023 instances, one query a frame').uncheck();
}));

test('a proxy volume lights a block from the served texture', () => visit(link(kOutside), async page => {
    await ready(page);
    const served = page.waitForResponse(response => response.url().endsWith('/v1/lppv'));
    await page.getByLabel('Proxy volume for a large object').check();
    expect((await served).status()).toBe(200);
    const block = () => page.evaluate(() => {
        const {query} = (window as any).tetralight;  // eslint-disable-line
        return query.box.block.visible as boolean;
    });
    await expect.poll(block).toBe(true);
    // From the room to the court: warm at one end, blue at the other.
    await page.getByLabel('Center of the box, metres x').fill('0');
    await page.getByLabel('Center of the box, metres z').fill('4');
    await page.getByLabel('Size of the box, metres x').fill('1');
    const second = page.waitForResponse(response => response.url().endsWith('/v1/lppv') &&
        (response.request().postData() ?? '').includes('"bounds":[-0.5,'));
    await page.getByLabel('Size of the box, metres z').fill('12');
    await page.keyboard.press('Tab');
    await second;
    /** How much redder than blue the block's top is. */
    const warmth = async (z: number) => {
        const [red, , blue] = await colorAt(page, await placeOf(page, [0.3, 2, z]));
        return red / blue;
    };
    await expect.poll(async () => await warmth(-1) / await warmth(7)).toBeGreaterThan(1.3);
}));
