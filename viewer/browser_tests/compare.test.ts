// SPDX-License-Identifier: Apache-2.0
// Two lights of one scene: a divider, their difference, and where light leaks.
import type {Page} from 'playwright-core';
import {afterAll, beforeAll, expect, test} from 'vitest';

import type {LeakPlace} from '../src/compare/leak_check';
import {addressOf, canvasMiddle, close, colorAt, inLink, open, ready} from './browser';
import {Server} from './server';
import {visit} from './visit';

let server: Server;
let scene: string;
let first: string;
let second: string;
const kView = 'hidden=probes,cells&eye=9.5,5,18&target=-0.5,0.7,0.7&exposure=0.5&object=4.2,1.6,8';

beforeAll(async () => {
    server = await new Server().start();
    scene = await server.uploadCourtyard();
    const order = {scene, samples: 32, name: 'court', layers: ['sun', 'sky', 'emission']};
    first = await server.bake({...order, bounces: 0});
    second = await server.bake(order);
});
afterAll(async () => {
    await close();
    await server?.end();
});

const link = (more = '') => `${server.url}/#tab=compare&volume=${second}&${kView}${more}`;
const show = (page: Page, mode: string) => page.getByRole('radio', {name: mode}).check();
const divider = (page: Page) => page.getByRole('slider', {name: 'Divider between left and right'});
const label = (page: Page, words: string | RegExp) => page.locator('.compare .side', {hasText: words}).waitFor();
/** What the panel says of the difference. */
async function difference(page: Page): Promise<number[]> {
    const facts = page.getByText(/^Mean difference/);
    await facts.waitFor();
    return [...(await facts.textContent())!.matchAll(/(\d+\.\d+) (?:stops|%)/g)].map(match => Number(match[1]));
}

test('with all layers at twice their weight, the picture is one stop brighter everywhere', () => visit(
    link().replace('tab=compare', 'tab=view'), async page => {
        await ready(page);
        for (const input of await page.locator('#panel-view input[type=range][min="0"][max="4"]').all()) await input.fill('2');
        await page.getByRole('tab', {name: 'Compare'}).click();
        await page.getByLabel('Left', {exact: true}).selectOption({value: second});
        await show(page, 'Difference');
        await expect.poll(() => difference(page)).toEqual([1, 1]);
        await page.getByLabel('Difference in').selectOption('percent');
        await expect.poll(async () => (await difference(page)).map(Math.round)).toEqual([100, 100]);
        const ticks = page.locator('.legend .ticks span');
        expect(await ticks.allTextContents()).toEqual(['−50', '−25', '0', '+25', '+50']);
    }));

test('a volume does not differ from itself', () => visit(
    link(`&compare=difference&left=VOLUME&right=open`).replace('VOLUME', second), async page => {
        await ready(page);
        await expect.poll(() => difference(page)).toEqual([0, 0]);
    }));

test('a comparison is metered by its right side', () => visit(link(), async page => {
    await ready(page);
    const exposure = () => page.evaluate(async () => {
        const {stage} = (window as any).tetralight.viewer;  // eslint-disable-line
        stage.exposure = 1;
        await stage.exposeItself(0);
        return stage.exposure as number;
    });
    await show(page, 'Off');
    await expect.poll(() => page.locator('.compare').isHidden()).toBe(true);
    const ofOpenVolume = await exposure();
    expect(ofOpenVolume).not.toBe(1);
    for (const [mode, words] of [['Wipe', 'Right: The open volume'], ['Difference', /^Difference of/]] as const) {
        await show(page, mode);
        await label(page, words);
        expect(await exposure()).toBeCloseTo(ofOpenVolume, 6);
    }
}));

test('each side of the divider is the picture of its own light', () => visit(link('&compare=wipe&left=none&right=none'), async page => {
    await ready(page);
    const {x, y} = await canvasMiddle(page);
    const places = [-0.5, -0.25, 0.25, 0.5].map(share => ({x: x + share * x, y: y + 60}));
    const colors = () => Promise.all(places.map(place => colorAt(page, place)));
    await label(page, 'Left: No probes: no ambient light');
    const dark = await colors();
    await show(page, 'Off');
    await expect.poll(async () => await page.locator('.compare').isHidden()).toBe(true);
    const lit = await colors();
    expect(dark).not.toEqual(lit);
    await page.getByLabel('Right', {exact: true}).selectOption('The open volume');
    await label(page, 'Right: The open volume');
    expect(await colors()).toEqual([dark[0], dark[1], lit[2], lit[3]]);
    await divider(page).focus();
    for (let i = 0; i < 4; ++i) await page.keyboard.press('Shift+ArrowLeft');
    expect(await divider(page).getAttribute('aria-valuenow')).toBe('10');
    expect(await colors()).toEqual(lit);  // all places are right of it
    await page.keyboard.press('End');
    expect(await colors()).toEqual(dark);
    const handle = (await divider(page).boundingBox())!;
    await page.mouse.move(handle.x + handle.width / 4, handle.y + handle.height / 2);  // half of it is out of the view
    await page.mouse.down();
    await page.mouse.move(x, y, {steps: 4});
    await page.mouse.up();
    expect(await divider(page).getAttribute('aria-valuenow')).toBe('50');
    await page.getByRole('button', {name: 'Stop comparing'}).click();
    expect(await colors()).toEqual(lit);
}));

test('usual comparisons are one click, and the address holds them', () => visit(link(), async page => {
    await ready(page);
    await label(page, 'Left: No probes: one ambient color');
    await page.getByRole('button', {name: 'Before and after the bake'}).click();
    await label(page, /^Left: court, \d/);
    expect(await inLink(page, 'left')).toBe(first);
    await page.getByRole('button', {name: 'Walls ignored and honored'}).click();
    await label(page, 'Left: The open volume, walls ignored');
    await show(page, 'Difference');
    await page.getByText('Difference of “The open volume” to “The open volume, walls ignored”').waitFor();
    expect((await difference(page))[1]).toBeGreaterThan(0);
    const other = await open(await addressOf(page));
    await other.getByText('Difference of “The open volume” to “The open volume, walls ignored”').waitFor();
    await other.context().close();
    await page.getByRole('button', {name: 'Swap sides'}).click();
    await page.getByText('Difference of “The open volume, walls ignored” to “The open volume”').waitFor();
}));

test('a volume that is gone is named, and the open one takes its place', () => visit(
    link('&compare=wipe&left=none_of_these&right=open'), async page => {
        await ready(page);
        await page.getByText(/none_of_these/).first().waitFor();
        await label(page, 'Left: The open volume');
    }, {refusal: /status of 404/}));

test('leaks are found, listed and shown', () => visit(link(), async page => {
    await ready(page);
    await page.getByLabel('Places', {exact: true}).selectOption('250');
    await page.getByRole('button', {name: 'Check for leaks'}).click();
    await page.getByText(/^250 places checked\. Light through walls: mean/).waitFor();
    const reports = await Promise.all([0, 1].map(seed => server.request<{all_places: LeakPlace[]}>(
        'POST', '/v1/check-leaks', JSON.stringify({scene, volume: second, places: 125, samples: 128, seed, all_places: true}))));
    const places = reports.flatMap(report => report.all_places);
    const sum = (value: (place: LeakPlace) => number) => places.reduce((total, place) => total + value(place), 0);
    const mean = sum(place => place.through_walls) / sum(place => place.traced);
    const facts = (await page.getByText(/^250 places checked/).textContent())!;
    expect(Number(/mean ([\d.e-]+) %/.exec(facts)![1])).toBe(Number((100 * mean).toPrecision(2)));
    await page.getByLabel('Map', {exact: true}).selectOption('Error against traced light');
    const worst = places.reduce((a, b) => Math.abs(b.answer - b.traced) > Math.abs(a.answer - a.traced) ? b : a);
    await page.getByRole('button', {name: /^Show the place/}).first().click();
    await page.getByRole('button', {name: 'Copy link'}).click();
    const target = (await inLink(page, 'target'))!.split(',').map(Number);
    target.forEach((x, axis) => expect(x).toBeCloseTo(worst.position[axis], 2));
    expect(await page.locator('tr[aria-current=true]').count()).toBe(1);
}));
