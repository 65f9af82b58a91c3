// SPDX-License-Identifier: Apache-2.0
// Probe groups by hand, and bakes.
import type {Page} from 'playwright-core';
import {afterAll, beforeAll, expect, test} from 'vitest';

import {canvasMiddle, close, colorAt, inLink, ready, typeInto} from './browser';
import {Server} from './server';
import {visit} from './visit';

let server: Server;

beforeAll(async () => {
    server = await new Server().start();
    await server.bake({scene: await server.uploadCourtyard(), samples: 32, name: 'court'});
});
afterAll(async () => {
    await close();
    await server?.end();
});

const facts = (page: Page) => page.locator('#panel-edit .facts').first();
const button = (page: Page, name: string) => page.getByRole('button', {name, exact: true});
const selection = (page: Page, words: string) => page.getByText(words, {exact: true}).waitFor();
/** All that names the volume names the one that is shown. */
async function named(page: Page, name: string, probes: RegExp): Promise<void> {
    const volume = page.getByLabel('Probe volume');
    await expect.poll(() => volume.locator('option:checked').textContent()).toBe(name);
    await page.locator('#status', {hasText: new RegExp(`courtyard · ${name}: ${probes.source}`)}).waitFor();
    expect(await inLink(page, 'volume')).toBe(await volume.inputValue());
    await button(page, 'Copy link').click();
    expect(await inLink(page, 'volume')).toBe(await volume.inputValue());
}
const edited = (page: Page, words: string | RegExp) => page.locator('#panel-edit .facts', {hasText: words}).waitFor();
/** Nothing but probes, seen from below (green, where the sky behind is blue) at a place that has none yet. */
const kLawn = '/#hidden=scene,cells&eye=0,-2,24&target=0,3,21&exposure=1';

test('groups are edited, undone, saved and baked again, and the change is seen', () => visit(server.url + kLawn, async page => {
    await ready(page);
    const middle = await canvasMiddle(page);
    const before = await colorAt(page, middle);
    await page.getByRole('tab', {name: 'Edit'}).click();
    await edited(page, '255 probes in 5 groups, joined by 1 367 tetrahedra');
    await button(page, 'Select all').click();
    await button(page, 'Delete').click();
    expect(await facts(page).textContent()).toBe('0 probes in 5 groups');
    await button(page, 'Undo').click();
    expect(await facts(page).textContent()).toMatch(/^255 probes/);
    await button(page, 'Add probe').click();
    const height = page.getByLabel(/^Position of probe \d+ of .+ y$/);
    expect(await height.inputValue()).toBe('3');
    await height.fill('2.5');
    await height.press('Tab');
    await button(page, 'Undo').click();
    expect(await height.inputValue()).toBe('3');
    await edited(page, /^256 probes in 5 groups, joined by/);

    await page.getByLabel('Name', {exact: true}).fill('edited');
    await button(page, 'Save').click();
    await page.locator('#status', {hasText: 'Saved as edited.'}).waitFor();
    await page.getByRole('tab', {name: 'Bake'}).click();
    await page.locator('select[multiple] option:checked', {hasText: 'edited'}).waitFor({state: 'attached'});
    await page.getByLabel('Name of the volume').fill('after');
    await page.getByLabel('Samples', {exact: true}).fill('32');
    await button(page, 'Bake').click();
    await page.getByRole('tab', {name: 'View'}).click();
    await page.locator('#panel-view .facts', {hasText: /^256 probes/}).waitFor();
    const after = await colorAt(page, middle);
    expect(Math.max(...after.map((channel, i) => Math.abs(channel - before[i])))).toBeGreaterThan(10);
    await named(page, 'after', /256 probes/);
    await page.getByRole('tab', {name: 'Bake'}).click();
    await page.locator('.bakes li', {hasText: /^court done/}).getByRole('button', {name: 'Open'}).click();
    await named(page, 'court', /255 probes/);
}));

test('nothing of what was joined while editing stays on the server', async () => {
    const names = async (kind: string) => (await server.request<Record<string, {name: string}[]>>(
        'GET', `/v1/${kind}`))[kind].map(file => file.name).sort();
    await expect.poll(() => names('groups')).toEqual(['edited']);
    await expect.poll(() => names('volumes')).toEqual(['after', 'court']);
});

test('probes are chosen by box and click, and moved by handles and keys', () => visit(
    server.url + '/#tab=edit&hidden=scene,cells&eye=0,60,0.1&target=0,0,0', async page => {
        await ready(page);
        const box = (await page.locator('#view canvas').boundingBox())!;
        await page.keyboard.down('Shift');
        await page.mouse.move(box.x + 1, box.y + 1);
        await page.mouse.down();
        await page.mouse.move(box.x + box.width - 1, box.y + box.height - 1, {steps: 3});
        await page.mouse.up();
        await page.keyboard.up('Shift');
        await page.getByText(/^25\d probes are selected\.$/).waitFor();
        await page.focus('#view canvas');
        await page.keyboard.press('Escape');
        await selection(page, 'Nothing is selected.');

        const place = await page.evaluate(() => {
            const {viewer, late} = (window as any).tetralight;  // eslint-disable-line
            const {positions} = late.edit.value.groups.editor;
            return viewer.stage.pageFrom(viewer.stage.camera.position.clone().fromArray(positions, 0)) as {x: number; y: number};
        });
        await page.mouse.click(place.x, place.y);
        const x = page.getByLabel(/^Position of probe \d+ of .+ x$/);
        const start = Number(await x.inputValue());
        await page.keyboard.press('Alt+ArrowRight');
        expect(Number(await x.inputValue())).toBeGreaterThan(start);
        await page.keyboard.press('Control+z');
        expect(Number(await x.inputValue())).toBe(start);
        await dragRight(page, place);
        expect(Number(await x.inputValue())).toBeGreaterThan(start + 0.5);
        await page.keyboard.press('Control+z');
        expect(Number(await x.inputValue())).toBe(start);
        await page.keyboard.press('f');
        const target = await page.evaluate(
            () => (window as any).tetralight.viewer.stage.controls.target.x as number);  // eslint-disable-line
        expect(target).toBeCloseTo(start, 2);
    }));

/** Takes the handle right of a place, which has to be the x axis's, and drags it. */
async function dragRight(page: Page, from: {x: number; y: number}): Promise<void> {
    const isHot = () => page.evaluate(() => (window as any).tetralight.viewer.gizmo.isHot as boolean);  // eslint-disable-line
    let x = from.x + 20;
    for (; x < from.x + 120; x += 4) {
        await page.mouse.move(x, from.y);
        if (await isHot()) break;
    }
    await page.mouse.down();
    await page.mouse.move(x + 60, from.y, {steps: 4});
    await page.mouse.up();
}

test('a generated grid is a preview until it is saved', () => visit(server.url + '/#tab=edit', async page => {
    await ready(page);
    await page.getByLabel('Spacing, metres').fill('6');
    await button(page, 'Preview').click();
    await page.getByText('This is a preview').waitFor();
    await edited(page, /in 1 group, joined by/);
    const {groups} = await server.request<{groups: {name: string}[]}>('GET', '/v1/groups');
    expect(groups.filter(({name}) => name !== '').map(({name}) => name)).toEqual(['edited']);
}));

test('no edit is lost in silence', () => visit(
    server.url + '/#tab=edit&volume=court', async page => {
        await ready(page);
        const isAskedToStay = () => page.evaluate(() => !dispatchEvent(new Event('beforeunload', {cancelable: true})));
        const preview = page.getByText('This is a preview');
        await edited(page, /^255 probes/);
        expect(await isAskedToStay()).toBe(false);
        await button(page, 'Add probe').click();
        const x = page.getByLabel(/^Position of probe \d+ of .+ x$/);
        await x.fill('2.5');
        await x.press('Tab');
        for (const text of ['', '-', '1e400', 'abc']) {
            await typeInto(x, text);
            expect(await x.inputValue(), text).toBe('2.5');
        }
        await button(page, 'Undo').click();
        await button(page, 'Redo').click();
        expect(await button(page, 'Redo').isDisabled()).toBe(true);

        await button(page, 'Take those of the volume').click();
        await edited(page, /^255 probes/);
        await button(page, 'Undo').click();
        await edited(page, /^256 probes/);
        await page.getByLabel('Spacing, metres').fill('');
        await button(page, 'Preview').click();
        await page.locator('#banner', {hasText: 'Spacing, metres: the field is empty'}).waitFor();
        await page.getByLabel('Spacing, metres').fill('6');
        await button(page, 'Preview').click();
        await preview.waitFor();
        await button(page, 'Take those of the volume').click();
        await preview.waitFor({state: 'detached'});
        expect(await isAskedToStay()).toBe(false);
        await button(page, 'Undo').click();
        await preview.waitFor();
        await button(page, 'Undo').click();
        await edited(page, /^256 probes .+ joined by/);
        expect(await preview.count()).toBe(0);
        expect(await isAskedToStay()).toBe(true);

        const status = (words: string) => page.locator('#status', {hasText: words}).waitFor();
        for (const name of ['first', 'second']) {
            await page.getByLabel('Name', {exact: true}).fill(name);
            await button(page, 'Save').click();
            await status(`Saved as ${name}.`);
        }
        expect(await isAskedToStay()).toBe(false);
        await page.route('**/v1/groups?name=*', route => route.fulfill({status: 507, json: {detail: 'the disk is full'}}));
        await button(page, 'Save').click();
        await page.locator('#banner', {hasText: 'the disk is full'}).waitFor();
        expect(await page.textContent('#status')).toBe('The groups are not saved.');
    }, {refusal: /status of 507/}));

test('groups that are saved while they are joined stay on the server', () => visit(
    server.url + '/#tab=edit&volume=court', async page => {
        await ready(page);
        await edited(page, /^255 probes .+ joined by/);
        let isSaved = () => {};
        const saved = new Promise<void>(done => { isSaved = done; });
        await page.route('**/v1/tetrahedralize', route => saved.then(() => route.continue()));
        const asked = page.waitForRequest('**/v1/tetrahedralize');
        await button(page, 'Add probe').click();
        await asked;
        await page.getByLabel('Name', {exact: true}).fill('early');
        await button(page, 'Save').click();
        await page.locator('#status', {hasText: 'Saved as early.'}).waitFor();
        const removed = page.waitForResponse(response => response.request().method() === 'DELETE');
        isSaved();
        await removed;
        await edited(page, /^256 probes .+ joined by/);
        const {groups} = await server.request<{groups: {name: string}[]}>('GET', '/v1/groups');
        expect(groups.map(({name}) => name)).toContain('early');
    }));

test('a bake shows its progress and is cancelled', () => visit(server.url + '/#tab=bake', async page => {
    await ready(page);
    await page.getByLabel('Name of the volume').fill('long');
    for (const preset of ['production', 'custom']) await page.getByLabel('Preset').selectOption(preset);
    await page.getByLabel('Samples', {exact: true}).fill('1000000');
    await button(page, 'Bake').click();
    const row = page.locator('.bakes li', {hasText: 'long'});
    const cancel = row.getByRole('button', {name: 'Cancel'});
    await row.locator('.facts', {hasText: / of /}).waitFor();
    await cancel.focus();
    const before = await row.locator('.facts').textContent();
    await expect.poll(() => row.locator('.facts').textContent()).not.toBe(before);
    const hasFocus = (name: string) => row.getByRole('button', {name}).evaluate(one => one === document.activeElement);
    expect(await hasFocus('Cancel')).toBe(true);
    await page.keyboard.press('Enter');
    await row.getByText('cancelled').waitFor();
    await expect.poll(() => hasFocus('Forget')).toBe(true);
}));
