// SPDX-License-Identifier: Apache-2.0
import {readFileSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';

import type {Page} from 'playwright-core';
import {afterAll, beforeAll, expect, test} from 'vitest';

import {close, open, ready} from './browser';
import {Server} from './server';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
let server: Server;
let volume: string;

beforeAll(async () => {
    server = await new Server().start();
    const scene = await server.uploadCourtyard();
    volume = await server.bake({scene, samples: 32, name: 'court', layers: ['sun', 'sky', 'emission']});
});
afterAll(async () => {
    await close();
    await server.end();
});

test('the page shows the newest volume with the scene of its bake', async () => {
    const {page, errors} = await open(server.url);
    expect(await page.textContent('#status')).toBe('courtyard · court: 255 probes');
    expect(await page.textContent('#panel-view .facts')).toBe('255 probes, 1 367 tetrahedra');
    expect(errors).toEqual([]);
    await page.context().close();
});

test('a link holds the view', async () => {
    const first = await open(server.url);
    await first.page.click('#tab-query');
    const place = first.page.getByLabel('Position of the ball, metres x');
    await place.fill('4.5');
    await place.press('Tab');
    await first.page.focus('canvas');
    await first.page.keyboard.press('ArrowLeft');
    await first.page.getByRole('button', {name: 'Copy link'}).click();
    const link = first.page.url();
    expect(link).toContain(volume);
    const second = await open(link);
    expect(await second.page.getByRole('tab', {name: 'Query'}).getAttribute('aria-selected')).toBe('true');
    expect(await second.page.getByLabel('Position of the ball, metres x').inputValue()).toBe('4.5');
    const eye = (page: Page) => page.evaluate(() => new URLSearchParams(location.hash.slice(1)).get('eye'));
    expect(await eye(second.page)).toBe(await eye(first.page));
    expect([...first.errors, ...second.errors]).toEqual([]);
    await first.page.context().close();
    await second.page.context().close();
});

test('the weight of a layer changes the light of probes at once', async () => {
    const {page, errors} = await open(server.url);
    const light = () => page.evaluate(() => {
        const {viewer} = (window as unknown as {tetralight: {viewer: {light: {irradiance: Float32Array}}}}).tetralight;
        return viewer.light.irradiance.reduce((sum, x) => sum + Math.abs(x), 0);
    });
    const before = await light();
    for (const layer of ['sun', 'sky', 'emission']) await page.getByLabel(layer, {exact: true}).fill('0');
    const rest = await light();
    await page.getByLabel('sky', {exact: true}).fill('2');
    expect(rest).toBeLessThan(0.1 * before);
    expect(await light()).toBeGreaterThan(2 * rest);
    await page.getByRole('button', {name: 'Copy link'}).click();
    expect(page.url()).toContain('w.sun=0');
    expect(errors).toEqual([]);
    await page.context().close();
});

test('a killed server is noticed, and the page recovers when it is back', async () => {
    const {page, errors} = await open(server.url);
    await server.kill();
    await page.click('#tab-query');
    await page.getByLabel('Position of the ball, metres y').fill('3');
    await page.keyboard.press('Tab');
    await page.getByText('The server does not answer').waitFor();
    await server.start();
    await page.locator('#banner').waitFor({state: 'hidden'});
    await page.getByLabel('Position of the ball, metres y').fill('2');
    await page.keyboard.press('Tab');
    await page.getByText(/^(Hull c|C)ell \d+$/).waitFor();
    expect(errors).toEqual([]);
    await page.context().close();
});

test('a corrupt volume is refused in words, and the shown one stays', async () => {
    const {page, errors} = await open(server.url);
    const answer = await fetch(`${server.url}/v1/volumes/${volume}/file`);
    const bytes = new Uint8Array(await answer.arrayBuffer());
    bytes[bytes.length >> 1] ^= 0xff;
    const path = join(server.folder, 'broken.probes');
    writeFileSync(path, bytes);
    await page.locator('header input[type=file]').setInputFiles(path);
    await page.locator('#banner', {hasText: 'broken.probes'}).waitFor();
    expect(await page.textContent('#banner')).toMatch(/checksum|corrupt|damaged/);
    await page.locator('#status', {hasText: 'court: 255 probes'}).waitFor();
    expect(errors).toEqual([]);
    await page.context().close();
});

test.each([
    ['light', 1100, 640], ['dark', 1100, 640], ['light', 390, 760],
] as const)('axe finds nothing serious (%s, %d wide)', async (colorScheme, width, height) => {
    const {page, errors} = await open(server.url, {colorScheme, width, height});
    for (const tab of ['View', 'Query', 'Probes', 'Bakes', 'Health']) {
        await page.getByRole('tab', {name: tab}).click();
        await page.evaluate(axe);
        const violations = await page.evaluate(async () => {
            const {axe} = window as unknown as {axe: {run(): Promise<{violations: {id: string; impact: string; nodes: {html: string}[]}[]}>}};
            return (await axe.run()).violations.map(v => [v.id, v.impact, v.nodes[0].html]);
        });
        expect(violations.filter(([, impact]) => impact === 'serious' || impact === 'critical'), tab).toEqual([]);
        const isWide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
        expect(isWide, 'scrolls sideways').toBe(false);
    }
    expect(errors).toEqual([]);
    await page.context().close();
});

test('everything is reached by keyboard', async () => {
    const {page} = await open(server.url);
    const reached = new Set<string>();
    for (let i = 0; i < 40; ++i) {
        await page.keyboard.press('Tab');
        reached.add(await page.evaluate(() => {
            const focused = document.activeElement!;
            return focused.getAttribute('aria-label')?.slice(0, 12) ?? focused.id ?? '';
        }));
        if (await page.evaluate(() => document.activeElement!.id === 'tab-view')) break;
    }
    expect([...reached]).toEqual(expect.arrayContaining(['Scene', 'Probe volume', 'The scene in', 'tab-view']));
    await page.keyboard.press('ArrowRight');
    expect(await page.getByRole('tab', {name: 'Query'}).getAttribute('aria-selected')).toBe('true');
    await page.context().close();
});

test('an empty server says what to do', async () => {
    const other = await new Server().start();
    const {page, errors} = await open(other.url);
    expect(await page.textContent('.empty')).toContain('Upload a scene');
    expect(errors).toEqual([]);
    await page.context().close();
    await other.end();
});

test('a server with a token asks for it, and says that a wrong one is wrong', async () => {
    const other = await new Server('secret').start();
    const {page, errors} = await open(other.url, {isReady: false});
    await page.getByLabel('Token', {exact: true}).fill('wrong');
    await page.getByRole('button', {name: 'Enter'}).click();
    await page.getByText('The token is wrong.').waitFor();
    await page.getByLabel('Token', {exact: true}).fill('secret');
    await page.getByRole('button', {name: 'Enter'}).click();
    await page.locator('.empty').waitFor();
    expect(await page.locator('dialog[open]').count()).toBe(0);
    expect(errors).toEqual([]);
    await ready(page);
    await page.context().close();
    await other.end();
});
