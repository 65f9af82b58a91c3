// SPDX-License-Identifier: Apache-2.0
// The tab Bake: presets, the bar at the bottom, and a picture that improves while it bakes.
import type {Page} from 'playwright-core';
import {afterAll, beforeAll, expect, test} from 'vitest';

import {close, inLink, ready} from './browser';
import {Server} from './server';
import {visit} from './visit';

interface Bakes {
    bakes: {id: string; name: string; request: Record<string, unknown>}[];
}

/** A preview may be asked for as its bake ends. */
const kLatePreview = {refusal: /status of 404/};

let server: Server;

beforeAll(async () => {
    server = await new Server().start();
    await server.uploadCourtyard();
});
afterAll(async () => {
    await close();
    await server?.end();
});

const field = (page: Page, label: string) => page.getByLabel(label, {exact: true});
const button = (page: Page, name: string) => page.getByRole('button', {name, exact: true});

test('presets fill their fields, and a change by hand makes them custom', () => visit(`${server.url}/#tab=bake`, async page => {
    await ready(page);
    const preset = field(page, 'Preset');
    expect(await preset.inputValue()).toBe('preview');
    await page.getByText('For looking at: target error 5%, max samples 4096.').waitFor();
    await page.getByText('Samples', {exact: true}).first().click();
    expect(await field(page, 'Target error').inputValue()).toBe('5%');
    await preset.selectOption('production');
    await page.getByText(/^For the result: the defaults of all fields \(target error \d/).waitFor();
    expect(await field(page, 'Target error').inputValue()).toBe('');
    await preset.selectOption('preview');
    await field(page, 'Max samples').fill('2048');
    await field(page, 'Max samples').press('Tab');
    expect(await preset.inputValue()).toBe('custom');
    expect(await field(page, 'Target error').inputValue()).toBe('5%');
    await field(page, 'What to bake').selectOption('reflections');
    await page.getByLabel('Name of the reflection probes').waitFor();
    await preset.selectOption('preview');
    await page.getByText('For looking at: cube size 64, samples 32.').waitFor();
}));

test.each([[900, 600], [390, 844]])('the button and the progress are in view at %d × %d', (width, height) => visit(
    `${server.url}/#tab=bake`, async page => {
        await ready(page);
        await field(page, 'Preset').selectOption('custom');  // opens all that can be long
        const isInView = async (name: string) => {
            const {y, height: tall} = (await button(page, name).boundingBox())!;
            return y >= 0 && y + tall <= height;
        };
        expect(await isInView('Bake')).toBe(true);
        await field(page, 'Target error').fill('0.0001');
        await field(page, 'Max samples').fill('16777216');
        await field(page, 'Name of the volume').fill('endless');
        await button(page, 'Bake').click();
        await page.locator('.bake-bar .facts', {hasText: /^endless: /}).waitFor();
        expect(await isInView('Cancel the bake')).toBe(true);
        expect(await isInView('Bake')).toBe(true);
        await button(page, 'Cancel the bake').click();
        await page.locator('.bake-bar .work').waitFor({state: 'hidden'});
    }, {width, height}));

test('the light so far is shown while it bakes, with a slider for each layer', () => visit(
    `${server.url}/#tab=bake`, async page => {
        await ready(page);
        const unlit = await inLink(page, 'exposure');
        await field(page, 'Preset').selectOption('custom');
        await field(page, 'Target error').fill('0.0001');
        await field(page, 'Max samples').fill('16777216');
        await field(page, 'Name of the volume').fill('soon');
        await button(page, 'Bake').click();
        await page.locator('#status', {hasText: 'preview of soon: 255 probes'}).waitFor();
        const light = () => page.evaluate(
            () => [...(window as any).tetralight.viewer.volume.probes.irradiance.subarray(0, 2700)] as number[]);  // eslint-disable-line
        const first = await light();
        expect(Math.max(...first)).toBeGreaterThan(0);
        await expect.poll(() => inLink(page, 'exposure')).not.toBe(unlit);  // metered in the first light
        await expect.poll(light).not.toEqual(first);  // a later round
        await page.getByRole('tab', {name: 'View'}).click();
        for (const layer of ['sky', 'sun', 'emission']) {
            expect(await page.getByRole('slider', {name: layer, exact: true}).isVisible(), layer).toBe(true);
        }
        expect(await button(page, 'Keep as a volume').count()).toBe(0);
        await page.getByRole('tab', {name: 'Bake'}).click();
        await button(page, 'Cancel the bake').click();
        await page.locator('.bakes li', {hasText: 'soon cancelled'}).waitFor();
    }, kLatePreview));

test('a preview is small enough to be done soon, and opens when it is', () => visit(
    `${server.url}/#tab=bake`, async page => {
        await ready(page);
        await field(page, 'Name of the volume').fill('quick');
        await button(page, 'Bake').click();
        await page.locator('#status', {hasText: 'quick: 255 probes'}).waitFor();
        const row = page.locator('.bakes li', {hasText: 'quick done'});
        await row.locator('.facts', {hasText: /255 probes/}).waitFor();
        const {bakes} = await server.request<Bakes>('GET', '/v1/bakes');
        expect(bakes.find(({name}) => name === 'quick')!.request).toMatchObject(
            {target_error: 0.05, max_samples: 4096, layers: ['sky', 'sun', 'emission']});
    }, kLatePreview));

test('a layer that is switched off is not kept', () => visit(`${server.url}/#tab=bake`, async page => {
    await ready(page);
    await field(page, 'Name of the volume').fill('no emission');
    await page.getByRole('checkbox', {name: 'Emission'}).uncheck();
    await button(page, 'Bake').click();
    await page.locator('.bakes li', {hasText: 'no emission done'}).waitFor();
    const {bakes} = await server.request<Bakes>('GET', '/v1/bakes');
    expect(bakes.find(({name}) => name === 'no emission')!.request.layers).toEqual(['sky', 'sun']);
}, kLatePreview));

test('what is gone is said, with a way on', () => visit(`${server.url}/#tab=bake`, async page => {
    const scene = await server.uploadCourtyard();
    const volume = await server.bake({scene, name: 'old', samples: 64, layers: ['sky']});
    const {bakes} = await server.request<Bakes>('GET', '/v1/bakes');
    await page.reload();
    await ready(page);
    const row = page.locator('.bakes li', {hasText: 'old done'});
    const alert = (words: string) => page.locator('#banner', {hasText: words});
    await server.request('DELETE', `/v1/volumes/${volume}`);
    await row.getByRole('button', {name: 'Open'}).click();
    await alert('The volume of the bake old was deleted.').waitFor();
    await row.getByRole('button', {name: 'Use its settings'}).click();
    await page.locator('#banner').waitFor({state: 'hidden'});
    expect(await field(page, 'Preset').inputValue()).toBe('custom');
    expect(await field(page, 'Samples').inputValue()).toBe('64');
    expect(await page.getByRole('checkbox', {name: 'Sky'}).isChecked()).toBe(true);
    expect(await page.getByRole('checkbox', {name: 'Sun'}).isChecked()).toBe(false);
    await server.request('DELETE', `/v1/bakes/${bakes.find(({name}) => name === 'old')!.id}`);
    await row.getByRole('button', {name: 'Forget'}).click();
    await alert('The bake old is not in the list of the server any more.').waitFor();
    await row.waitFor({state: 'detached'});
    await button(page, 'Bake').click();
    await row.waitFor();
    await page.locator('#status', {hasText: 'old: 255 probes'}).waitFor();
}, {refusal: /404/}));
