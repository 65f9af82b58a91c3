// SPDX-License-Identifier: Apache-2.0
// Reflection probes on a mirror: a floor of metal below a box whose cube has a color on each side.
import {Page} from 'playwright-core';
import {afterAll, beforeAll, expect, test} from 'vitest';

import {probeAt, ProbeSetup, reflectionFile} from '../tests/reflection_file';
import {canvasMiddle, close, colorAt, ready} from './browser';
import {floorGlb} from './floor';
import {Server} from './server';
import {visit} from './visit';

const kAlbedo = 0.5;
const kFromAbove = 'eye=0,5,0.01&target=0,0,0&exposure=1';
/** Of the faces +X, -X, +Y, -Y, +Z, -Z. */
const kColors = [[1, 0, 0], [0, 0, 1], [1, 1, 1], [0, 0, 0], [0, 0, 0], [0, 0, 0]];

let server: Server;
let mirror: string;

beforeAll(async () => {
    server = await new Server().start();
    const upload = async (name: string, glb: Uint8Array<ArrayBuffer>) =>
        (await server.request<{id: string}>('POST', `/v1/scenes?name=${name}`, glb)).id;
    mirror = await upload('mirror', floorGlb(kAlbedo, {metallicFactor: 1, roughnessFactor: 0}));
});
afterAll(async () => {
    await close();
    await server?.end();
});

/** Answers for files of reflection probes that no bake would make, by their names. */
async function store(page: Page, files: Record<string, ArrayBuffer>): Promise<void> {
    const stored = Object.keys(files).map(id => ({id, name: id, names: [id], bytes: 1, created: 1, state: 'ready'}));
    await page.route('**/v1/reflections', route => route.fulfill({json: {reflections: stored, next: null}}));
    for (const file of stored) {
        await page.route(`**/v1/reflections/${file.id}`, route => route.fulfill({json: file}));
        await page.route(`**/v1/reflections/${file.id}/file`,
                         route => route.fulfill({body: Buffer.from(files[file.id])}));
    }
}

const cubes = (probes: ProbeSetup[], strength = 1) => reflectionFile(
    probes, [8, 4], probes.length, (cube, face) => kColors[face].map(x => cube === 0 ? strength * x : 0));

/** What 8 bits show of a grey radiance: Khronos PBR Neutral below its shoulder, and sRGB. */
function shown(radiance: number): number {
    const mapped = radiance - (radiance < 0.08 ? radiance - 6.25 * radiance ** 2 : 0.04);
    return 255 * (1.055 * mapped ** (1 / 2.4) - 0.055);
}

/** The floor's color at an x between -1 and 1. */
async function floorAt(page: Page, x: number): Promise<number[]> {
    const middle = await canvasMiddle(page);
    const place = await page.evaluate(at => {
        const {stage} = (window as any).tetralight.viewer;  // eslint-disable-line
        return stage.pageFrom(stage.controls.target.clone().setX(at)) as {x: number};
    }, x);
    return colorAt(page, {x: place.x, y: middle.y});
}

const choose = async (page: Page, name: string) => {
    await page.getByLabel('Reflection probes', {exact: true}).selectOption(name);
    await expect.poll(() => page.evaluate(() => location.hash)).toContain(name === '' ? 'tab=view' : `reflections=${name}`);
    if (name === '') await expect.poll(() => page.evaluate(() => location.hash)).not.toContain('reflections=');
};

// The floor from above: at x = 0 it mirrors what is straight above, and at x = ±1 rays that hit the ceiling of the
// box, 4 m high, at ±1.8. A cube that was captured 0.5 m below the ceiling shows that on its sides, ±X.
const inHall = (more: Partial<ProbeSetup> = {}) => probeAt([0, 3.5, 0], [-8, 0, -8], [8, 4, 8], more);

test('a mirror shows the side of the box that its ray hits', () => visit(
    `${server.url}/#scene=${mirror}&tab=view&${kFromAbove}`, async page => {
        await store(page, {hall: cubes([inHall()]), far: cubes([{...inHall(), box: null}])});
        await ready(page);  // a page that is left while it loads says so in the console
        await page.reload();
        await ready(page);
        for (const channel of await floorAt(page, 0)) expect(channel).toBeLessThan(20);  // no light of its own
        await choose(page, 'hall');
        for (const channel of await floorAt(page, 0)) expect(Math.abs(channel - shown(kAlbedo))).toBeLessThan(4);
        const [red, green, blue] = await floorAt(page, 1);
        expect(red).toBeGreaterThan(150);
        expect(Math.max(green, blue)).toBeLessThan(20);
        const [, , left] = await floorAt(page, -1);
        expect(left).toBeGreaterThan(150);
        // Without a box the light comes from far away: straight rays see the top only.
        await choose(page, 'far');
        for (const channel of await floorAt(page, 1)) expect(Math.abs(channel - shown(kAlbedo))).toBeLessThan(4);
        await page.getByLabel('Reflections', {exact: true}).uncheck();
        for (const channel of await floorAt(page, 0)) expect(channel).toBeLessThan(20);
        await page.getByLabel('Reflections', {exact: true}).check();
        await choose(page, '');
        for (const channel of await floorAt(page, 0)) expect(channel).toBeLessThan(20);
    }));

test('a mirror ball at a probe shows what its cube holds', () => visit(
    `${server.url}/#scene=${mirror}&tab=view&${kFromAbove}`, async page => {
        const place = [0, 1, 0] as [number, number, number];
        await store(page, {hall: cubes([probeAt(place, [-8, 0, -8], [8, 4, 8])], 0.5)});
        await ready(page);
        await page.reload();
        await ready(page);
        await choose(page, 'hall');
        // The floor has half of the ceiling's light; the ball, seen from above, has all of it.
        const middle = () => floorAt(page, 0);
        for (const channel of await middle()) expect(Math.abs(channel - shown(0.5 * kAlbedo))).toBeLessThan(4);
        await page.getByLabel('Mirror balls at the reflection probes').check();
        for (const channel of await middle()) expect(Math.abs(channel - shown(0.5))).toBeLessThan(4);
        await page.getByLabel('Mirror balls at the reflection probes').uncheck();
        for (const channel of await middle()) expect(Math.abs(channel - shown(0.5 * kAlbedo))).toBeLessThan(4);
    }));

test('each pixel blends the probes by their influence', () => visit(
    `${server.url}/#scene=${mirror}&${kFromAbove}`, async page => {
        // The white one covers x < -0.5 and ends 1 m farther; the black sky takes the rest: at x = 0 a half.
        const white = probeAt([-4, 2, 0], [-7.5, -4, -8], [-0.5, 40, 8], {blend_distance: 1});
        const file = reflectionFile([white, {...inHall(), box: null}], [8], 2, cube => cube === 0 ? [1, 1, 1] : [0, 0, 0]);
        await store(page, {halves: file});
        // The page removes a missing file from its link. So the link is opened after the file is stored.
        await page.goto('about:blank');
        await page.goto(`${server.url}/#scene=${mirror}&${kFromAbove}&reflections=halves`);
        await ready(page);
        const grey = async (x: number) => (await floorAt(page, x))[1];
        expect(Math.abs(await grey(-1) - shown(kAlbedo))).toBeLessThan(4);
        expect(Math.abs(await grey(0) - shown(kAlbedo / 2))).toBeLessThan(6);
        expect(await grey(1)).toBeLessThan(20);
    }));

/** The fraction of the canvas that is blue and nothing else. */
const blueShare = (page: Page) => page.evaluate(() => {
    const {stage} = (window as any).tetralight.viewer;  // eslint-disable-line
    stage.drawNow();
    const copy = document.createElement('canvas');
    copy.width = copy.height = 200;
    const context = copy.getContext('2d')!;
    context.drawImage(stage.canvas as HTMLCanvasElement, 0, 0, 200, 200);
    const {data} = context.getImageData(0, 0, 200, 200);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) count += Number(data[i + 2] > 2 * Math.max(data[i], data[i + 1], 20));
    return count / (200 * 200);
});

test('spheres of metal in the mesh ball mirror the cubes', async () => {
    const scene = await server.uploadCourtyard();
    const volume = await server.bake({scene, samples: 16});
    const blue = reflectionFile([{...inHall(), box: null}], [8], 1, () => [0, 0, 0.7]);
    const link = `scene=${scene}&volume=${volume}&hidden=scene,probes,cells&tab=inspect&object=2.6,1.3,6` +
        '&eye=2.6,1.3,12&target=2.6,1.3,6&exposure=1';
    await visit(`${server.url}/#${link}`, async page => {
        await store(page, {blue});
        await ready(page);
        await page.reload();
        await ready(page);
        await page.getByLabel('1023 instances, one query a frame').check();
        expect(await blueShare(page)).toBeLessThan(0.01);
        await page.evaluate(() => (window as any).tetralight.viewer.open.reflections('blue'));  // eslint-disable-line
        await expect.poll(() => blueShare(page)).toBeGreaterThan(0.03);
    });
});

test('stored files of reflection probes are baked, listed and opened', () => visit(
    `${server.url}/#scene=${mirror}&tab=bake&${kFromAbove}`, async page => {
        await server.request('POST', '/v1/reflection-bakes', JSON.stringify(
            {scene: mirror, name: 'baked', box: [-2, -0.1, -2, 2, 2, 2], sky: 1, samples: 16, cube_size: 16}));
        await ready(page);
        await page.reload();
        await ready(page);
        const row = page.locator('.bakes li', {hasText: /^baked done/});
        await row.waitFor();
        await row.getByRole('button', {name: 'Open'}).click();
        await expect.poll(() => page.evaluate(() => location.hash)).toContain('reflections=');
        await page.getByRole('tab', {name: 'View'}).click();
        const chosen = page.getByLabel('Reflection probes', {exact: true}).locator('option:checked');
        expect(await chosen.textContent()).toBe('baked');
    }));
