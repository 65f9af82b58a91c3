// SPDX-License-Identifier: Apache-2.0
import type {Page} from 'playwright-core';
import {afterAll, beforeAll, expect, test} from 'vitest';

import {ballPlace, close, colorAt, open} from './browser';
import {Server} from './server';

let server: Server;
const kInside = [0, 1.5, 0];   // the dark room, with a warm lamp
const kOutside = [0, 1.5, 8];  // the court: a blue sky above green ground

beforeAll(async () => {
    server = await new Server().start();
    const scene = await server.uploadCourtyard();
    await server.bake({scene, samples: 128, name: 'court', layers: ['sky', 'emission']});
});
afterAll(async () => {
    await close();
    await server.end();
});

const link = (object: number[]) => `${server.url}/#tab=query&hidden=scene,probes,cells` +
    `&eye=0,24,4.01&target=0,0,4&object=${object.join(',')}`;

const positionOf = (page: Page) => page.evaluate(
    () => (window as unknown as {tetralight: {query: {position: number[]}}}).tetralight.query.position);

/** Waits until the server has answered for where the ball is now. */
async function answered(page: Page): Promise<void> {
    await page.waitForFunction(() => {
        const {query} = (window as unknown as {tetralight: {query: {newest: {isBusy: boolean}; roundTrips: number[]}}}).tetralight;
        return !query.newest.isBusy && query.roundTrips.length > 0;
    });
}

test('dragged from the dark room into the court, the ball turns from warm to blue', async () => {
    const {page, errors} = await open(link(kInside));
    await answered(page);
    const start = await ballPlace(page);
    const [warmRed, , warmBlue] = await colorAt(page, start);
    const {x, y} = await page.evaluate(([px, py, pz]) => {
        type Place = {x: number; y: number};
        const {viewer, query} = (window as unknown as {tetralight: {viewer: {stage: {pageFrom(v: unknown): Place}};
            query: {object: {ball: {position: {clone(): {set(x: number, y: number, z: number): unknown}}}}}}}).tetralight;
        return viewer.stage.pageFrom(query.object.ball.position.clone().set(px, py, pz));
    }, kOutside);
    await page.mouse.move(start.x, start.y);
    await page.mouse.down();
    for (let step = 1; step <= 10; ++step) {
        await page.mouse.move(start.x + (x - start.x) * step / 10, start.y + (y - start.y) * step / 10);
    }
    await page.mouse.up();
    await answered(page);
    const position = await positionOf(page);
    position.forEach((value, axis) => expect(value).toBeCloseTo(kOutside[axis], 0));
    const [coolRed, , coolBlue] = await colorAt(page, await ballPlace(page));
    expect(warmRed).toBeGreaterThan(1.3 * warmBlue);
    expect(coolBlue).toBeGreaterThan(1.1 * coolRed);
    expect(errors).toEqual([]);
    await page.context().close();
});

test('the panel says the cell, its probes and weights that add up to 1', async () => {
    const {page, errors} = await open(link(kOutside));
    await page.getByText(/^Cell \d+$/).waitFor();
    const weights = await page.locator('.answer td.number').allTextContents();
    expect(weights).toHaveLength(4);
    expect(weights.reduce((sum, text) => sum + Number(text), 0)).toBeCloseTo(1, 2);
    expect(errors).toEqual([]);
    await page.context().close();
});

test('light blended in the page is the light that the server interpolates', async () => {
    const {page, errors} = await open(link(kOutside));
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
    expect(errors).toEqual([]);
    await page.context().close();
});

test('the mesh ball is lit by one query a frame', async () => {
    const {page, errors} = await open(link(kOutside));
    await answered(page);
    const bodies: number[] = [];
    page.on('request', request => {
        if (request.url().endsWith('/query')) bodies.push(request.postDataBuffer()?.length ?? 0);
    });
    await page.getByLabel('1023 instances, one query a frame').check();
    await expect.poll(() => bodies.length, {timeout: 30_000}).toBeGreaterThan(2);
    expect(new Set(bodies)).toEqual(new Set([16 + 1023 * 12]));
    const color = await colorAt(page, await ballPlace(page));
    expect(Math.max(...color)).toBeGreaterThan(20);
    await page.getByLabel('1023 instances, one query a frame').uncheck();
    expect(errors).toEqual([]);
    await page.context().close();
});

test('a proxy volume lights a block from the served texture', async () => {
    const {page, errors} = await open(link(kOutside));
    const served = page.waitForResponse(response => response.url().endsWith('/v1/lppv'));
    await page.getByLabel('A box of light for a large object').check();
    expect((await served).status()).toBe(200);
    const block = () => page.evaluate(() => {
        const {query} = (window as any).tetralight;  // eslint-disable-line
        return query.box.block.visible as boolean;
    });
    await expect.poll(block, {timeout: 30_000}).toBe(true);
    // Its middle line from the room to the court: as warm and as blue as the ball is there.
    await page.getByLabel('Middle of the box, metres x').fill('0');
    await page.getByLabel('Middle of the box, metres z').fill('4');
    await page.getByLabel('Size of the box, metres x').fill('1');
    const second = page.waitForResponse(response => response.url().endsWith('/v1/lppv') &&
        (response.request().postData() ?? '').includes('"bounds":[-0.5,'));
    await page.getByLabel('Size of the box, metres z').fill('12');
    await page.keyboard.press('Tab');
    await second;
    await page.waitForTimeout(1500);
    const at = (z: number) => page.evaluate(depth => {
        const {viewer, query} = (window as any).tetralight;  // eslint-disable-line
        const place = query.object.ball.position.clone().set(0.3, 2, depth);
        return viewer.stage.pageFrom(place) as {x: number; y: number};
    }, z);
    const inside = await colorAt(page, await at(-1));
    const outside = await colorAt(page, await at(7));
    expect(inside[0] / inside[2]).toBeGreaterThan(1.3 * outside[0] / outside[2]);
    expect(errors).toEqual([]);
    await page.context().close();
});
