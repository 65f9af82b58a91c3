// SPDX-License-Identifier: Apache-2.0
// Adjustment volumes, portals and reflection boxes, by visible labels.
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';

import type {Page} from 'playwright-core';
import {afterAll, beforeAll, expect, test} from 'vitest';

import {close, inLink, ready} from './browser';
import {run, Server} from './server';
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

const button = (page: Page, name: string) => page.getByRole('button', {name, exact: true});
const edit = (page: Page, what: string) => page.getByRole('radio', {name: what, exact: true}).check();
const field = (page: Page, label: string) => page.getByLabel(label, {exact: true});

async function put(page: Page, label: string, value: string): Promise<void> {
    await field(page, label).fill(value);
    await field(page, label).press('Tab');
}

/** What the command reads of the stored scene of a name. */
async function explain(name: string): Promise<string> {
    const {scenes} = await server.request<{scenes: {id: string}[]}>('GET', `/v1/scenes?name=${encodeURIComponent(name)}`);
    const bytes = await fetch(`${server.url}/v1/scenes/${scenes[0].id}/file`).then(answer => answer.arrayBuffer());
    const path = join(server.folder, 'saved.glb');
    writeFileSync(path, new Uint8Array(bytes));
    return run('explain', path, '--json');
}

test('boxes of each kind are added, changed, undone, and saved in the scene, where the command finds them', () => visit(
    server.url + '/#tab=edit&eye=9,6,15&target=0,1,0', async page => {
        await ready(page);
        await edit(page, 'Adjustment volumes');
        await page.getByText('The scene has no adjustment volumes yet.').waitFor();
        await button(page, 'Add volume').click();
        expect(await field(page, 'Name').inputValue()).toBe('volume');
        await put(page, 'Position, metres x', '1.5');
        await put(page, 'Size, metres y', '2.5');
        await put(page, 'Name', 'stage');
        await button(page, 'Undo').click();
        expect(await field(page, 'Name').inputValue()).toBe('volume');
        await button(page, 'Redo').click();
        expect(await field(page, 'Name').inputValue()).toBe('stage');
        await field(page, 'Probes in it').selectOption('as around it');
        await button(page, 'Save in the scene').click();
        await page.locator('#banner', {hasText: 'The volume "stage" has no effect: set at least one value.'}).waitFor();
        await put(page, 'Intensity, factor', '0.5');

        await edit(page, 'Portals');
        await button(page, 'Add portal').click();
        await put(page, 'Width and height, metres x', '1.4');
        await put(page, 'Rotation, degrees y', '90');
        await edit(page, 'Reflection boxes');
        await button(page, 'Add reflection box').click();
        await put(page, 'Blend distance, metres', '0.1');
        await button(page, 'Duplicate').click();
        expect(await field(page, 'Name').inputValue()).toBe('reflection 2');
        await button(page, 'Delete').click();
        await page.getByText('Not saved yet.').waitFor();

        await button(page, 'Save in the scene').click();
        await page.locator('#status', {hasText: 'Saved as courtyard edited.'}).waitFor();
        await page.getByText('All are saved in the scene.').waitFor();
        await expect.poll(() => page.getByRole('combobox', {name: 'Scene', exact: true}).locator('option:checked').textContent())
            .toBe('courtyard edited');
        await expect.poll(() => inLink(page, 'eye')).toBe('9,6,15');
        const found = await explain('courtyard edited');
        for (const name of ['stage', 'window', 'reflection']) expect(found, name).toContain(`\\"${name}\\"`);
        expect(found).not.toContain('reflection 2');
        await button(page, 'Undo').click();
        await page.getByText('Not saved yet.').waitFor();
    }));

test('a volume is moved by keys, and its sides by handles in steps', () => visit(
    server.url + '/#tab=edit&volume=court&scene=courtyard&hidden=cells&eye=0,2,14&target=0,2,0', async page => {
        await ready(page);
        await edit(page, 'Adjustment volumes');
        await page.focus('canvas');
        await page.keyboard.press('a');
        const x = field(page, 'Position, metres x');
        await x.waitFor();
        expect(await x.inputValue()).toBe('0');
        await page.keyboard.press('Alt+ArrowRight');
        expect(await x.inputValue()).toBe('0.25');
        await page.keyboard.press('Control+z');
        expect(await x.inputValue()).toBe('0');
        await page.keyboard.press('r');
        expect(await page.getByRole('radio', {name: 'Size'}).isChecked()).toBe(true);
        const width = field(page, 'Size, metres x');
        await dragSide(page, 37);
        const snapped = Number(await width.inputValue());
        expect(snapped).toBeGreaterThan(2);
        expect(snapped % 0.25).toBe(0);
        expect(Number(await x.inputValue())).toBe((snapped - 2) / 2);
        await page.keyboard.press('Control+z');
        expect(await width.inputValue()).toBe('2');
        await page.keyboard.down('Control');
        await dragSide(page, 37);
        await page.keyboard.up('Control');
        expect(Number(await width.inputValue()) % 0.25).not.toBe(0);
        await page.keyboard.press('Delete');
        await page.getByText('The scene has no adjustment volumes yet.').waitFor();
    }));

/** Drags the side at the right of the selected box, which is 2 m wide and at (0, 2, 0). */
async function dragSide(page: Page, pixels: number): Promise<void> {
    const {x, y} = await page.evaluate(() => {
        const {stage} = (window as any).tetralight.viewer;  // eslint-disable-line
        return stage.pageFrom(stage.camera.position.clone().set(1, 2, 0)) as {x: number; y: number};
    });
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + pixels, y, {steps: 4});
    await page.mouse.up();
}

test('coverage follows edits of probes, and places where probes are forbidden do not count', () => visit(
    server.url + '/#tab=edit&volume=court&scene=courtyard', async page => {
        await ready(page);
        const share = page.getByRole('region', {name: 'Coverage of the free space'}).locator('output');
        await page.getByText(/of the free space sees its probes/).waitFor();
        const before = await share.textContent();
        expect(parseFloat(before!)).toBeGreaterThan(30);
        await button(page, 'Select all').click();
        await button(page, 'Delete').click();
        await expect.poll(() => share.textContent()).toBe('0.0 %');
        await button(page, 'Undo').click();
        await expect.poll(() => share.textContent()).toBe(before);
        await edit(page, 'Adjustment volumes');
        await button(page, 'Add volume').click();
        for (const [axis, size] of ['100', '100', '100'].entries()) await put(page, `Size, metres ${'xyz'[axis]}`, size);
        await page.getByText('The scene has no free space.').waitFor();
        await button(page, 'Delete').click();
        await expect.poll(() => share.textContent()).toBe(before);
    }));

test('files for the command are downloaded', () => visit(
    server.url + '/#tab=edit&volume=court&scene=courtyard', async page => {
        await ready(page);
        await edit(page, 'Adjustment volumes');
        await button(page, 'Add volume').click();
        const file = page.waitForEvent('download');
        await button(page, 'Download adjustments.json').click();
        const text = readFileSync((await (await file).path())!, 'utf8');
        expect(JSON.parse(text)).toMatchObject({adjustments: [{name: 'volume', shape: 'box', size: [2, 2, 2], forbid: true}]});
        await put(page, 'Rotation, degrees y', '15');
        await button(page, 'Download adjustments.json').click();
        await page.locator('#banner', {hasText: 'volume: the file of --adjustments holds no rotations'}).waitFor();
        await button(page, 'Close').click();
    }));
