// SPDX-License-Identifier: Apache-2.0
// For everyone: screen readers, keyboards, phones.
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';

import type {Page} from 'playwright-core';
import {afterAll, beforeAll, expect, test} from 'vitest';

import {close, ready} from './browser';
import {Server} from './server';
import {visit} from './visit';

const kAxe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const kTabs = ['View', 'Inspect', 'Compare', 'Edit', 'Bake', 'Health'];
let server: Server;

beforeAll(async () => {
    server = await new Server().start();
    const scene = await server.uploadCourtyard();
    await server.bake({scene, samples: 32, name: 'court', layers: ['sun', 'sky', 'emission']});
});
afterAll(async () => {
    await close();
    await server?.end();
});

interface Violation {
    id: string;
    nodes: {html: string}[];
}

/** What axe-core finds against WCAG 2.2 AA. */
async function violations(page: Page): Promise<string[]> {
    if (!await page.evaluate(() => 'axe' in window)) await page.evaluate(kAxe);
    const found = await page.evaluate(async () => {
        const {axe} = window as unknown as {axe: {run(options: object): Promise<{violations: Violation[]}>}};
        const runOnly = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22a', 'wcag22aa'];
        return (await axe.run({runOnly, resultTypes: ['violations']})).violations;
    });
    return found.map(({id, nodes}) => `${id}: ${nodes.map(({html}) => html).join(' ')}`);
}

const kSizes = [[1400, 850], [900, 600], [390, 844]];

/** Looks at a state in all sizes, light and dark. */
async function check(page: Page, state: string): Promise<void> {
    for (const [width, height] of kSizes) {
        await page.setViewportSize({width, height});
        for (const colorScheme of ['light', 'dark'] as const) {
            await page.emulateMedia({colorScheme, reducedMotion: 'reduce'});  // colours at once
            expect(await violations(page), `${state}, ${width} wide, ${colorScheme}`).toEqual([]);
        }
        const isWide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
        expect(isWide, `${state}, ${width} wide, scrolls sideways`).toBe(false);
    }
}

const button = (page: Page, name: string | RegExp) => page.getByRole('button', {name, exact: true}).first();
const says = (page: Page, words: string | RegExp) => page.getByText(words).first().waitFor();

test('each tab', () => visit(server.url, async page => {
    await ready(page);
    for (const tab of kTabs) {
        await page.getByRole('tab', {name: tab}).click();
        await check(page, tab);
    }
}));

test('selections, and the list of keys', () => visit(server.url, async page => {
    await ready(page);
    await page.getByText('Light in numbers').click();
    for (const name of ['beam_long (moves)', 'box_blue', 'Ball']) {
        await page.getByLabel('Objects of the scene').selectOption({label: name});
        await page.getByRole('rowheader', {name: 'above', exact: true}).waitFor();
        await check(page, name);
    }
    await button(page, /^probe \d+$/).click();
    await page.getByRole('heading', {name: /^Probe \d+$/}).waitFor();
    await check(page, 'a probe');
    await page.getByLabel('Proxy volume for a large object').check();
    await check(page, 'a proxy volume');
    await button(page, 'Keys and mouse').click();
    await check(page, 'the list of keys');
}));

test('comparisons and leaks', () => visit(`${server.url}/#tab=compare`, async page => {
    await ready(page);
    await says(page, 'Left: No probes: one ambient color');
    await check(page, 'wipe');
    await page.getByRole('radio', {name: 'Difference'}).check();
    await says(page, /^Mean difference/);
    await check(page, 'difference');
    await page.getByLabel('Places', {exact: true}).selectOption('250');
    await button(page, 'Check for leaks').click();
    await says(page, /^250 places checked/);
    await page.getByLabel('Map', {exact: true}).selectOption('Error against traced light');
    await button(page, /^Show the place/).click();
    await check(page, 'leaks');
}));

test('editing', () => visit(`${server.url}/#tab=edit`, async page => {
    await ready(page);
    await says(page, /^255 probes .+ joined by/);
    await button(page, 'Add probe').click();
    await says(page, /^Position of probe/);
    await check(page, 'a selected probe');
    for (const [kind, add] of [['Adjustment volumes', 'Add volume'], ['Portals', 'Add portal'], ['Reflection boxes', 'Add reflection box']]) {
        await page.getByRole('radio', {name: kind}).check();
        await button(page, add).click();
        await check(page, kind);
    }
}));

test('a bake that runs, and one that was cancelled', () => visit(`${server.url}/#tab=bake`, async page => {
    await ready(page);
    for (const preset of ['production', 'custom']) await page.getByLabel('Preset').selectOption(preset);
    await page.getByLabel('Samples', {exact: true}).fill('1000000');
    await button(page, 'Bake').click();
    await button(page, 'Cancel the bake').waitFor();
    await check(page, 'a bake');
    await button(page, 'Cancel the bake').click();
    await says(page, 'cancelled');
    await check(page, 'a cancelled bake');
}, {refusal: /status of 404/}));

test('an alert, without a scene', () => visit(`${server.url}/#tab=bake`, async page => {
    await ready(page);
    await page.locator('#choose').getByLabel('Scene').selectOption('');
    await button(page, 'Bake').click();
    await says(page, 'Open a scene first');
    await check(page, 'an alert');
    await button(page, 'Close').click();
}));

test('an empty server that needs a token, and a scene without a volume', async () => {
    const other = await new Server('a-secret-of-20-chars').start();
    await visit(other.url, async page => {
        await page.getByLabel('Token', {exact: true}).fill('wrong');
        await button(page, 'Enter').click();
        await says(page, 'The token is wrong.');
        await check(page, 'the question for the token');
        await page.getByLabel('Token', {exact: true}).fill('a-secret-of-20-chars');
        await button(page, 'Enter').click();
        await says(page, 'No scene or volume yet');
        await check(page, 'an empty server');
        await other.uploadCourtyard();
        await page.reload();
        await says(page, 'No volume yet');
        await check(page, 'a scene without a volume');
    }, {refusal: /status of 401/});
    await other.end();
});

test('tabs and the view are reached by keyboard', () => visit(server.url, async page => {
    await ready(page);
    const reached = new Set<string>();
    const isThere = () => page.evaluate(() => document.activeElement!.id === 'tab-inspect');
    for (let i = 0; i < 40 && !await isThere(); ++i) {
        await page.keyboard.press('Tab');
        reached.add(await page.evaluate(() => {
            const focused = document.activeElement!;
            return focused.getAttribute('aria-label')?.slice(0, 12) ?? focused.id ?? '';
        }));
    }
    expect([...reached]).toEqual(expect.arrayContaining(['Scene', 'Probe volume', 'The scene in', 'tab-inspect']));
    await page.keyboard.press('ArrowRight');
    const compare = page.getByRole('tab', {name: 'Compare'});
    expect(await compare.evaluate(tab => tab === document.activeElement)).toBe(true);
    expect(await compare.getAttribute('aria-selected')).toBe('false');  // who goes past it starts no comparison
    await page.keyboard.press('Enter');
    expect(await compare.getAttribute('aria-selected')).toBe('true');
}));
