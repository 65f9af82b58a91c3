// SPDX-License-Identifier: Apache-2.0
// Bakes of lightmaps in the page, and their light on the scene.
import type {Page} from 'playwright-core';
import {afterAll, beforeAll, expect, test} from 'vitest';

import {canvasMiddle, close, colorAt, ready} from './browser';
import {floorGlb} from './floor';
import {Server} from './server';
import {visit} from './visit';

const kAlbedo = 0.5;
/** The floor from above, at an exposure of 1. */
const kFromAbove = 'eye=0,5,0.1&target=0,0,0&exposure=1';

let server: Server;
let floor: string;
let court: string;

beforeAll(async () => {
    server = await new Server().start();
    const scene = await server.request<{id: string}>('POST', '/v1/scenes?name=floor', floorGlb(kAlbedo));
    floor = scene.id;
    court = await server.uploadCourtyard();
});
afterAll(async () => {
    await close();
    await server?.end();
});

const button = (page: Page, name: string) => page.getByRole('button', {name, exact: true});
const field = (page: Page, label: string) => page.getByLabel(label, {exact: true});

/** What 8 bits show of a grey radiance: Khronos PBR Neutral below its shoulder, and sRGB. */
function shown(radiance: number): number {
    const mapped = radiance - (radiance < 0.08 ? radiance - 6.25 * radiance ** 2 : 0.04);
    return 255 * (1.055 * mapped ** (1 / 2.4) - 0.055);
}

async function order(page: Page, name: string, settings: Record<string, string>): Promise<void> {
    await page.getByRole('tab', {name: 'Bake'}).click();
    await field(page, 'What to bake').selectOption('lightmaps');
    await field(page, 'Name of the lightmaps').fill(name);
    await field(page, 'Texels per meter').waitFor({state: 'attached'});
    await field(page, 'Preset').selectOption('production');
    for (const details of await page.locator('#panel-bake details').all()) {
        await details.evaluate(one => { (one as HTMLDetailsElement).open = true; });
    }
    for (const [label, value] of Object.entries(settings)) await field(page, label).fill(value);
    await button(page, 'Bake').click();
}

const hasLightmaps = (page: Page) => page.evaluate(
    () => (window as any).tetralight.viewer.lightmaps !== null);  // eslint-disable-line

test('finished lightmaps light the scene as they were baked', () => visit(
    `${server.url}/#scene=${floor}&${kFromAbove}`, async page => {
        await ready(page);
        const middle = await canvasMiddle(page);
        expect(Math.max(...await colorAt(page, middle))).toBeLessThan(20);
        // E = π · L under a sky of radiance L, of which the floor reflects albedo · E / π.
        await order(page, 'lit', {'Samples': '1024', 'Sky': '1', 'Texels per meter': '4', 'Page size': '64'});
        await page.locator('#status', {hasText: 'The bake lit is done.'}).waitFor();
        await expect.poll(() => hasLightmaps(page)).toBe(true);
        const expected = shown(kAlbedo);
        const isLit = async () => {
            for (const channel of await colorAt(page, middle)) expect(Math.abs(channel - expected)).toBeLessThan(4);
        };
        await isLit();
        const row = page.locator('.bakes li', {hasText: /^lit done/});
        await row.locator('.facts', {hasText: /texels, 1 page/}).waitFor();

        await page.getByRole('tab', {name: 'View'}).click();
        await page.getByLabel('Lightmaps', {exact: true}).uncheck();
        expect(Math.max(...await colorAt(page, middle))).toBeLessThan(20);
        await page.getByLabel('Lightmaps', {exact: true}).check();
        await isLit();
    }));

test('stored lightmaps are opened on their scene', () => visit(
    `${server.url}/#scene=${court}&tab=bake&${kFromAbove}`, async page => {
        await ready(page);
        await page.locator('.bakes li', {hasText: /^lit done/}).getByRole('button', {name: 'Open'}).click();
        await expect.poll(() => hasLightmaps(page)).toBe(true);
        await page.evaluate(address => { location.hash = address; }, `scene=${floor}&${kFromAbove}`);
        await ready(page);
        const expected = shown(kAlbedo);
        await expect.poll(async () => Math.abs((await colorAt(page, await canvasMiddle(page)))[1] - expected)).toBeLessThan(4);
        expect(await page.getByRole('combobox', {name: 'Scene'}).inputValue()).toBe(floor);
    }));

test('a bake shows texels at the target, and its light on the scene', () => visit(
    `${server.url}/#scene=${court}&hidden=probes,cells`, async page => {
        await ready(page);
        await order(page, 'endless', {'Target error': '0.0001', 'Max samples': '16777216', 'Texels per meter': '1',
                                      'Page size': '256'});
        const row = page.locator('.bakes li', {hasText: 'endless'});
        await row.locator('.facts', {hasText: /of 5 575 texels, [\d ]+ at the target error/}).waitFor();
        expect(await hasLightmaps(page)).toBe(false);
        await expect.poll(() => hasLightmaps(page)).toBe(true);
        // The camera stays, and the scene is the one that was open.
        expect(await page.getByRole('combobox', {name: 'Scene'}).inputValue()).toBe(court);
        await row.getByRole('button', {name: 'Cancel'}).click();
        await row.getByText('cancelled').waitFor();
        expect(await hasLightmaps(page)).toBe(true);
    }));

test('a wrong setting of lightmaps marks its field', () => visit(
    `${server.url}/#scene=${court}&tab=bake`, async page => {
        await ready(page);
        await order(page, 'wrong', {'Page size': '0'});
        await page.locator('#banner', {hasText: /^Page size: /}).waitFor();
        expect(await field(page, 'Page size').getAttribute('aria-invalid')).toBe('true');
    }, {refusal: /status of 400/}));
