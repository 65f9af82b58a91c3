// SPDX-License-Identifier: Apache-2.0
import type {Page} from 'playwright-core';
import {afterAll, beforeAll, expect, test} from 'vitest';

import {close, open} from './browser';
import {Server} from './server';

let server: Server;

beforeAll(async () => {
    server = await new Server().start();
    const scene = await server.uploadCourtyard();
    await server.bake({scene, samples: 32, name: 'court'});
});
afterAll(async () => {
    await close();
    await server.end();
});

const probes = (page: Page) => page.locator('#panel-groups .facts').first();
const button = (page: Page, name: string) => page.getByRole('button', {name, exact: true});

test('groups are edited, undone, saved and baked again, and the change is seen', async () => {
    const {page, errors} = await open(server.url + '/#tab=groups');
    await expect.poll(() => probes(page).textContent(), {timeout: 60_000})
        .toBe('255 probes in 5 groups, joined by 1 367 tetrahedra');
    await button(page, 'Select all').click();
    await button(page, 'Delete').click();
    expect(await probes(page).textContent()).toMatch(/^0 probes/);
    await button(page, 'Undo').click();
    expect(await probes(page).textContent()).toMatch(/^255 probes/);
    await button(page, 'Redo').click();
    await button(page, 'Undo').click();

    await button(page, 'Add probe').click();
    const legend = /^Position of probe 79 of court/;
    await page.getByLabel(/^Position of probe 79 of court y/).fill('3.25');
    await page.keyboard.press('Tab');
    await expect.poll(() => probes(page).textContent(), {timeout: 60_000}).toMatch(/^256 probes.*tetrahedra$/);
    expect(await page.getByText(legend).count()).toBe(1);

    await page.getByLabel('Name', {exact: true}).fill('edited');
    await button(page, 'Save').click();
    await page.locator('#status', {hasText: 'Saved as edited.'}).waitFor();
    await page.getByRole('tab', {name: 'Bakes'}).click();
    await page.locator('select[multiple] option:checked', {hasText: 'edited'}).waitFor({state: 'attached'});
    await page.getByLabel('Name of the volume').fill('after');
    await page.getByLabel('Samples', {exact: true}).fill('32');
    await button(page, 'Bake').click();
    await page.locator('#status', {hasText: 'after'}).waitFor();
    await page.getByRole('tab', {name: 'View'}).click();
    await expect.poll(() => page.textContent('#panel-view .facts'), {timeout: 60_000}).toMatch(/^256 probes/);
    expect(errors).toEqual([]);
    await page.context().close();
});

test('nothing of what was joined while editing stays on the server', async () => {
    const names = async (kind: string) => (await server.request<Record<string, {name: string}[]>>(
        'GET', `/v1/${kind}`))[kind].map(file => file.name).sort();
    await expect.poll(() => names('groups')).toEqual(['edited']);
    await expect.poll(() => names('volumes')).toEqual(['after', 'court']);
});

test('a generated grid is a preview until it is saved', async () => {
    const {page, errors} = await open(server.url + '/#tab=groups');
    await page.getByLabel('Spacing, metres').fill('6');
    await button(page, 'Preview').click();
    await page.getByText('This is a preview').waitFor();
    await expect.poll(() => probes(page).textContent(), {timeout: 60_000}).toMatch(/in 1 groups, joined by/);
    expect(errors).toEqual([]);
    await page.context().close();
});

test('a click in the table of health selects the probe in 3D', async () => {
    const {page, errors} = await open(server.url + '/#tab=health');
    const first = page.getByRole('button', {name: /^Show probe/}).first();
    const name = await first.getAttribute('aria-label');
    await first.click();
    const selected = await page.evaluate(
        () => (window as unknown as {tetralight: {viewer: {selectedProbe: number}}}).tetralight.viewer.selectedProbe);
    expect(name).toBe(`Show probe ${selected}`);
    expect(errors).toEqual([]);
    await page.context().close();
});

test('a bake shows its progress and is cancelled', async () => {
    const {page, errors} = await open(server.url + '/#tab=bakes');
    await page.getByLabel('Name of the volume').fill('long');
    await page.getByLabel('Samples', {exact: true}).fill('1000000');
    await button(page, 'Bake').click();
    const row = page.locator('.bakes li', {hasText: 'long'});
    await row.locator('progress').waitFor();
    await row.getByRole('button', {name: 'Cancel'}).click();
    await row.getByText('cancelled').waitFor();
    expect(errors).toEqual([]);
    await page.context().close();
});

test('wrong settings are refused in the server’s words', async () => {
    const {page, errors} = await open(server.url + '/#tab=bakes');
    await page.getByLabel('Bounces', {exact: true}).fill('-1');
    await button(page, 'Bake').click();
    await page.locator('#banner', {hasText: 'bounces'}).waitFor();
    expect(errors).toEqual([]);
    await page.context().close();
});
