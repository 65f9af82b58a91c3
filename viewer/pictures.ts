// SPDX-License-Identifier: Apache-2.0
// The pictures of docs/viewer.md as PNG: a furnished room, baked by the service while the page shows it.
// Arguments: the scene (examples/scenes/make_room.py), a folder.
import {mkdirSync, readFileSync} from 'node:fs';
import {join} from 'node:path';

import type {Page} from 'playwright-core';

import {close, newContext, Options, ready} from './browser_tests/browser';
import {run, Server} from './browser_tests/server';

const [room, folder] = process.argv.slice(2);
const kSize = {width: 1200, height: 720};
const kWide = 'eye=4.9,1.5,4.35&target=2.9,1.12,1.2';
/** The lamps are off. */
const kDay = 'w.emission=0&w.light:floor_lamp_light=0&w.light:pendant_light=0';
mkdirSync(folder, {recursive: true});

const server = await new Server().start();
const byName = (page: Page, role: 'button' | 'tab' | 'radio' | 'checkbox', name: string) =>
    page.getByRole(role, {name, exact: true});

async function open(link: string, options: Options = kSize): Promise<Page> {
    const page = await (await newContext(options)).newPage();
    await page.goto(`${server.url}/#${link}`);
    await ready(page);
    return page;
}

async function fillVector(page: Page, label: string, values: number[]): Promise<void> {
    for (const [axis, value] of values.entries()) {
        const field = page.getByLabel(`${label} ${'xyz'[axis]}`);
        await field.fill(String(value));
        await field.press('Tab');
    }
}

const selectMover = (name: string) => async (page: Page) => {
    await page.getByLabel('Objects of the scene').selectOption({label: `${name} (moves)`});
    await page.getByRole('heading', {name, exact: true}).waitFor();
};

async function save(page: Page, name: string): Promise<void> {
    await page.waitForTimeout(1000);  // until the last click has taken effect
    await drawFully(page);
    await page.screenshot({path: join(folder, `${name}.png`)});
    console.log(name);
}

const drawFully = (page: Page) => page.evaluate(() => (window as any).tetralight.viewer.stage.drawNow());  // eslint-disable-line

/** What moves by itself stands still. */
const stop = (page: Page) => page.evaluate(() => { window.requestAnimationFrame = () => 0; });

/** Opens the page, prepares it and saves its picture. */
async function picture(name: string, link: string, prepare = async (_: Page) => {}, options: Options = kSize): Promise<void> {
    const page = await open(link, options);
    await prepare(page);
    await save(page, name);
    await page.context().close();
}

/** The light so far, each time it has improved, until the bake is done. */
async function follow(page: Page, name: string, begin: () => Promise<void>): Promise<void> {
    const light = () => page.evaluate(() => {
        const {viewer} = (window as any).tetralight;  // eslint-disable-line
        const seen = (window as any).seenLight ??= new Set();  // eslint-disable-line
        for (const shown of [viewer.volume, viewer.lightmaps]) if (shown) seen.add(shown);
        return seen.size as number;
    });
    const before = await light();
    await begin();
    for (let shown = before, isDone = false, frame = 1; !isDone;) {
        isDone = await page.locator('.bakes li', {hasText: `${name} done`}).isVisible();
        const now = await light();
        if (now === shown && !isDone) await page.waitForTimeout(100);
        else await save(page, `${name}_${frame++}`);
        shown = now;
    }
}

try {
    const {id: scene} = await server.request<{id: string}>('POST', '/v1/scenes?name=room', readFileSync(room));
    const grid = join(folder, 'room.json');
    run('grid', room, '--spacing', '0.5', '--min', '0,0,-1.42', '--max', '6,2.7,4.6', '--from', '2,1.5,2.8', '-o', grid);
    await server.request('POST', '/v1/groups?name=room', readFileSync(grid));

    const page = await open(`scene=${scene}&tab=bake&hidden=probes`);
    await page.getByLabel('Stored groups to add').selectOption({label: 'room'});
    await page.getByLabel('Preset').selectOption('custom');
    await page.getByLabel('Target error', {exact: true}).fill('3%');
    await page.getByLabel('Max samples', {exact: true}).fill('4096');
    await page.getByLabel('What to bake').scrollIntoViewIfNeeded();
    await save(page, 'room_0');
    await follow(page, 'room', () => byName(page, 'button', 'Bake').click());
    await byName(page, 'tab', 'Bake').click();
    await page.getByLabel('What to bake').selectOption('lightmaps');
    await page.getByLabel('Preset').selectOption('custom');
    await page.getByLabel('Name of the lightmaps').fill('light');
    await page.getByLabel('Texels per meter', {exact: true}).fill('12');
    await page.getByLabel('Samples', {exact: true}).fill('48');
    await page.getByLabel('What to bake').scrollIntoViewIfNeeded();
    await follow(page, 'light', () => byName(page, 'button', 'Bake').click());
    await page.context().close();

    const link = `volume=room&${kDay}`;
    await picture('viewer_inspect', `${link}&hidden=probes`, selectMover('vase'));
    await picture('viewer_crowd', `${link}&hidden=probes&${kWide}&object=3.2,1.5,1.9`, async page => {
        await page.getByLabel('Radius, metres').fill('0.5');
        await page.getByLabel('1023 instances, one query a frame').check();
        await page.getByLabel('Proxy volume for a large object').check();
        await fillVector(page, 'Center of the box, metres', [2.7, 0.2, 2.2]);
        await fillVector(page, 'Size of the box, metres', [2.4, 0.3, 0.3]);
        await page.waitForTimeout(2000);
        await stop(page);
    });
    await picture('viewer_groups', `${link}&tab=edit`, async page => {
        await byName(page, 'button', 'Take those of the volume').click();
        await page.getByText(/joined by/).waitFor();
        await page.keyboard.press('Control+A');
        await page.getByText(/of the free space sees/).waitFor();
    });
    await picture('viewer_edit', `${link}&tab=edit&hidden=probes`, async page => {
        await byName(page, 'radio', 'Reflection boxes').check();
        await page.getByRole('listbox', {name: 'Reflection boxes'}).selectOption({label: 'room_reflections'});
        await byName(page, 'radio', 'Size').check();
        await page.getByText(/of the free space sees/).waitFor();
    });
    await picture('viewer_health', `${link}&tab=health&color=error`);
    await picture('viewer_phone', `${link}&hidden=probes`, async () => {}, {width: 390, height: 780});
    await picture('viewer_compare', `${link}&tab=compare`, async page => {
        await byName(page, 'button', 'Without and with probes').click();
        await page.getByText(/^Right: /).waitFor();
    });
    await picture('viewer_difference', `${link}&tab=compare`, async page => {
        await byName(page, 'button', 'Walls ignored and honored').click();
        await byName(page, 'radio', 'Difference').check();
        await page.getByText(/^Mean difference/).waitFor();
    });
} finally {
    await close();
    await server.end();
}
