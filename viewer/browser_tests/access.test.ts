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
const kTabs = ['View', 'Query', 'Probes', 'Bakes', 'Health'];
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
    impact: string;
    nodes: {html: string}[];
}

/** What axe-core finds that is serious or worse. */
async function seriousViolations(page: Page): Promise<string[]> {
    await page.evaluate(kAxe);
    const found = await page.evaluate(async () => {
        const {axe} = window as unknown as {axe: {run(): Promise<{violations: Violation[]}>}};
        return (await axe.run()).violations;
    });
    return found.filter(({impact}) => impact === 'serious' || impact === 'critical')
        .map(({id, nodes}) => `${id}: ${nodes[0].html}`);
}

test.each([
    ['light', 1100, 640], ['dark', 1100, 640], ['light', 390, 760],
] as const)('axe finds nothing serious in any tab (%s, %d wide)', (colorScheme, width, height) => visit(
    server.url, async page => {
        await ready(page);
        for (const tab of kTabs) {
            await page.getByRole('tab', {name: tab}).click();
            expect(await seriousViolations(page), tab).toEqual([]);
            const isWide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
            expect(isWide, `${tab} scrolls sideways`).toBe(false);
        }
    }, {colorScheme, width, height}));

test('tabs and the view are reached by keyboard', () => visit(server.url, async page => {
    await ready(page);
    const reached = new Set<string>();
    const isThere = () => page.evaluate(() => document.activeElement!.id === 'tab-view');
    for (let i = 0; i < 40 && !await isThere(); ++i) {
        await page.keyboard.press('Tab');
        reached.add(await page.evaluate(() => {
            const focused = document.activeElement!;
            return focused.getAttribute('aria-label')?.slice(0, 12) ?? focused.id ?? '';
        }));
    }
    expect([...reached]).toEqual(expect.arrayContaining(['Scene', 'Probe volume', 'The scene in', 'tab-view']));
    await page.keyboard.press('ArrowRight');
    expect(await page.getByRole('tab', {name: 'Query'}).getAttribute('aria-selected')).toBe('true');
}));
