// SPDX-License-Identifier: Apache-2.0
// Twelve things that a technical artist wants to do, by the labels of the page and in at most eight actions each:
// once by pointer, once by keyboard alone (docs/viewer.md).
import type {Page} from 'playwright-core';
import {afterAll, beforeAll, expect, test} from 'vitest';

import {canvasMiddle, close, colorAt, inLink, open, Place, ready} from './browser';
import {Hands, Keyboard, Pointer} from './hands';
import {Server} from './server';
import {visit} from './visit';

const kMostActions = 8;
const kCourt = '&eye=9.5,5,18&target=-0.5,0.7,0.7';
const kRoom = '&eye=0.5,2,2.6&target=-0.5,1.2,-2';
const kPath = '&eye=11,4,14&target=5.5,1.5,6';  // in front of the house

let server: Server;
let volume: string;
let sparse: string;  // no probe is in the house

beforeAll(async () => {
    server = await new Server().start();
    const scene = await server.uploadCourtyard();
    const order = {scene, samples: 32, name: 'court', layers: ['sun', 'sky', 'material:emissive_warm', 'material:emissive_cool']};
    await server.bake({...order, bounces: 0});
    volume = await server.bake(order);
    const corners = [-12, 12].flatMap(x => [0.5, 9].flatMap(y => [-12, 12].map(z => [x, y, z])));
    const {id} = await server.request<{id: string}>('POST', '/v1/groups', JSON.stringify({groups: [{name: 'few', positions: corners}]}));
    sparse = await server.bake({scene, samples: 32, name: 'few', groups: [id], only_given_groups: true});
});
afterAll(async () => {
    await close();
    await server?.end();
});

const tab = ({page}: Hands, name: string) => page.getByRole('tab', {name});
const button = ({page}: Hands, name: string | RegExp) => page.getByRole('button', {name, exact: true}).first();
const labelled = ({page}: Hands, label: string) => page.getByLabel(label, {exact: true});
const view = ({page}: Hands) => page.getByRole('application', {name: /^The scene in 3D/});
const says = ({page}: Hands, words: string | RegExp) => page.getByText(words).first().waitFor();
const textOf = async ({page}: Hands, words: RegExp) => (await page.getByText(words).first().textContent())!;
const status = ({page}: Hands, words: string) => page.getByRole('status').filter({hasText: words}).first().waitFor();
const heading = ({page}: Hands, name: string | RegExp) => page.getByRole('heading', {name, exact: true}).waitFor();
const times = (count: number, key: string) => Array<string>(count).fill(key);

/** Where a position of the world is in the page. */
const placeOf = ({page}: Hands, position: number[]) => page.evaluate(([x, y, z]) => {
    const {stage} = (window as any).tetralight.viewer;  // eslint-disable-line
    return stage.pageFrom(stage.camera.position.clone().set(x, y, z)) as Place;
}, position);

async function drag(page: Page, from: Place, to: Place): Promise<void> {
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(to.x, to.y, {steps: 5});
    await page.mouse.up();
}

/** An object that is seen at a place of the world: a click, or its name in the list. */
async function select(hands: Hands, name: string, at: number[]): Promise<void> {
    const {x, y} = await placeOf(hands, at);
    if (hands instanceof Pointer) await hands.inView(view(hands), () => hands.page.mouse.click(x, y), []);
    else await hands.choose(labelled(hands, 'Objects of the scene'), name);
    await heading(hands, name);
    await hands.page.evaluate(() => new Promise(shown => requestAnimationFrame(() => setTimeout(shown))));  // with its light
}

/** What the panel shows as the average light, 0 to 255. */
async function averageLight(hands: Hands): Promise<number[]> {
    const code = await textOf(hands, /^#[0-9a-f]{6}$/);
    return [1, 3, 5].map(at => parseInt(code.slice(at, at + 2), 16));
}
const sum = (numbers: number[]) => numbers.reduce((total, x) => total + x, 0);

/** How far the probes are that light what is selected, metres. */
const distances = async ({page}: Hands) => (await page.getByRole('cell', {name: /^[\d.]+ m$/}).allTextContents()).map(parseFloat);

interface Task {
    name: string;
    actions: number;
    /** What the link says besides the volume. */
    from?: string;
    isOfSparse?: boolean;
    work(hands: Hands): Promise<void>;
}

const kTasks: Task[] = [{
    name: 'find why this corner is dark', actions: 3, from: `${kRoom}&object=0.5,0.6,0.5`,
    async work(hands) {
        const {x, y} = await placeOf(hands, [3.7, 0.6, -2.6]);
        await hands.inView(view(hands), () => hands.page.mouse.dblclick(x, y),
                           [...times(3, 'Alt+Shift+ArrowRight'), ...times(3, 'Alt+Shift+ArrowUp')]);
        const words = /^([\d.]+) stops darker than the mean of all probes: (.+)\.$/;
        await says(hands, words);
        const [, stops, sources] = words.exec(await textOf(hands, words))!;
        const share = (layer: string) => Number(new RegExp(`(\\d+) % ${layer}`).exec(sources)![1]);
        const shares = ['sky', 'sun', 'emissive_warm', 'emissive_cool'].map(share);
        expect(Number(stops)).toBeGreaterThan(0.5);
        expect(Math.abs(sum(shares) - 100)).toBeLessThan(3);  // each is rounded
        expect(share('sun')).toBeLessThan(30);                // that is why
        expect(share('emissive_cool')).toBeLessThan(3);
        await hands.press(hands.page.getByText('Light in numbers'));
        await hands.page.getByRole('rowheader', {name: 'above', exact: true}).waitFor();
        await hands.press(button(hands, /^probe \d+$/));
        await says(hands, /^probe \d+, validity [\d.]+, error/);
    },
}, {
    name: 'see the room by its warm lamp alone', actions: 6, from: `${kRoom}&object=0.5,0.6,-1`,
    async work(hands) {
        const before = await averageLight(hands);
        await hands.press(tab(hands, 'View'));
        for (const layer of ['sun', 'sky', 'material:emissive_cool']) await hands.slide(labelled(hands, layer), 0);
        await hands.press(button(hands, 'Meter this view'));
        await hands.press(tab(hands, 'Inspect'));
        await says(hands, /the mean of all probes: 100 % emissive_warm/);
        const [red, green, blue] = await averageLight(hands);
        expect(red / blue).toBeGreaterThan(1.5 * before[0] / before[2]);
        expect(red).toBeGreaterThan(green);
        const wall = await colorAt(hands.page, await placeOf(hands, [-0.5, 2.5, -2.75]));
        expect(wall[0]).toBeGreaterThan(1.5 * wall[2]);
    },
}, {
    name: 'place probes on this path and bake', actions: 7, from: `${kPath}&object=5.5,1.2,6`,
    async work(hands) {
        const before = Math.min(...await distances(hands));
        await hands.press(tab(hands, 'Edit'));
        await says(hands, /^255 probes .+ joined by/);
        await hands.press(button(hands, 'Add probe'));
        await hands.press(button(hands, 'Duplicate'));
        await says(hands, /^257 probes .+ joined by/);
        await hands.press(button(hands, 'Save'));
        await status(hands, 'Saved as groups.');
        await hands.press(tab(hands, 'Bake'));
        await hands.press(button(hands, 'Bake'));
        await status(hands, 'courtyard: 257 probes');
        await hands.press(tab(hands, 'Inspect'));
        expect(before).toBeGreaterThan(0.4);
        await expect.poll(async () => Math.min(...await distances(hands))).toBeLessThan(0.4);
    },
}, {
    name: 'compare before and after a bake', actions: 4, from: kCourt,
    async work(hands) {
        const {page} = hands;
        const middle = await canvasMiddle(page);
        const left = {x: middle.x - 60, y: middle.y};
        await hands.press(tab(hands, 'Compare'));
        await hands.press(button(hands, 'Before and after the bake'));
        await says(hands, /^Left: court, \d/);
        const before = await colorAt(page, left);
        const divider = page.getByRole('slider', {name: 'Divider between left and right'});
        await hands.inView(divider, () => drag(page, middle, {x: middle.x / 5, y: middle.y}), ['Home']);
        await expect.poll(async () => Number(await divider.getAttribute('aria-valuenow'))).toBeLessThan(25);
        expect(sum(await colorAt(page, left))).toBeGreaterThan(sum(before) + 3);  // bounces are light
        await hands.press(page.getByRole('radio', {name: 'Difference'}));
        const words = /^Mean difference ([\d.]+) stops/;
        await says(hands, words);
        expect(Number(words.exec(await textOf(hands, words))![1])).toBeGreaterThan(0);
    },
}, {
    name: 'find where light leaks through a wall', actions: 4, from: kCourt, isOfSparse: true,
    async work(hands) {
        await hands.press(tab(hands, 'Compare'));
        await hands.choose(labelled(hands, 'Places'), '250');
        await hands.press(button(hands, 'Check for leaks'));
        await says(hands, /^250 places checked\. Light through walls: mean [\d.e-]+ %/);
        const worst = button(hands, /^Show the place/);
        const place = (await worst.textContent())!.split(', ').map(Number);
        expect(Math.abs(place[0])).toBeLessThan(4);  // in the house
        expect(Math.abs(place[2])).toBeLessThan(3);
        await hands.press(worst);
        await expect.poll(async () => (await inLink(hands.page, 'target'))?.split(',').map(x => Number(x).toFixed(2)))
            .toEqual(place.map(x => x.toFixed(2)));
    },
}, {
    name: 'make the picture two stops brighter, with AgX', actions: 3, from: `${kCourt}&hidden=probes`,
    async work(hands) {
        const lawn = await placeOf(hands, [3, 0, 12]);
        const before = await colorAt(hands.page, lawn);
        await hands.press(tab(hands, 'View'));
        await hands.choose(labelled(hands, 'Tone mapping'), 'AgX: soft highlights');
        await hands.slide(labelled(hands, 'Exposure, stops'), 2);
        await says(hands, /^(3\.[6-9]|4(\.[0-4])?) times as bright as metered\.$/);  // a step of the slider is a tenth of a stop
        expect(await inLink(hands.page, 'tone')).toBe('agx');
        expect(sum(await colorAt(hands.page, lawn))).toBeGreaterThan(1.5 * sum(before));
    },
}, {
    name: 'see which probes light this object, and how much', actions: 2, from: kCourt,
    async work(hands) {
        await select(hands, 'box_blue', [1.6, 0.7, 9.6]);
        const weights = (await hands.page.getByRole('cell', {name: /^[01]\.\d{3}$/}).allTextContents()).map(Number);
        expect(weights.length).toBeGreaterThan(2);
        expect(sum(weights)).toBeCloseTo(1, 2);
        const probe = button(hands, /^probe \d+$/);
        const name = (await probe.textContent())!;
        await hands.press(probe);
        await heading(hands, name.replace('p', 'P'));
    },
}, {
    name: 'move an object into the house and see its light change', actions: 2, from: '&eye=2,5,16&target=2,1,3&hidden=probes',
    async work(hands) {
        const [from, to] = [await placeOf(hands, [2, 0.5, 6.2]), await placeOf(hands, [2, 0.5, 0.2])];
        await select(hands, 'sphere_sun_front', [2, 0.5, 6.2]);
        const before = await averageLight(hands);
        await hands.inView(view(hands), () => drag(hands.page, from, to), times(6, 'Alt+Shift+ArrowUp'));
        const z = labelled(hands, 'Position of sphere_sun_front, metres z');
        await expect.poll(async () => Number(await z.inputValue())).toBeCloseTo(0.2, 0);
        await expect.poll(async () => sum(await averageLight(hands))).toBeLessThan(0.9 * sum(before));
        await says(hands, /stops darker than the mean of all probes/);
    },
}, {
    name: 'undo an edit of probe groups', actions: 4,
    async work(hands) {
        await hands.press(tab(hands, 'Edit'));
        const all = '255 probes in 5 groups, joined by 1 367 tetrahedra';
        await says(hands, all);
        await hands.press(button(hands, 'Select all'));
        await hands.press(button(hands, 'Delete'));
        await says(hands, '0 probes in 5 groups');
        await hands.press(button(hands, 'Undo'));
        await says(hands, all);
    },
}, {
    name: 'bake a preview and dim its sky', actions: 5, from: kCourt,
    async work(hands) {
        await hands.press(tab(hands, 'Bake'));
        await hands.enter(labelled(hands, 'Name of the volume'), 'quick');
        await hands.press(button(hands, 'Bake'));
        await status(hands, 'quick: 255 probes');
        await hands.press(tab(hands, 'View'));
        const shade = await placeOf(hands, [0, 0.1, 1]);
        const before = await colorAt(hands.page, shade);
        await hands.slide(labelled(hands, 'sky'), 0);
        await expect.poll(async () => sum(await colorAt(hands.page, shade))).toBeLessThan(0.9 * sum(before));
    },
}, {
    name: 'send a colleague a link to this view', actions: 2, from: '&hidden=probes',
    async work(hands) {
        const {page} = hands;
        await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
        const middle = await canvasMiddle(page);
        await hands.inView(view(hands), () => drag(page, middle, {x: middle.x + 80, y: middle.y + 20}), times(3, 'ArrowLeft'));
        await hands.press(button(hands, 'Copy link'));
        await status(hands, 'The link is copied.');
        const other = await open(await page.evaluate(() => navigator.clipboard.readText()));
        for (const key of ['volume', 'eye', 'target']) expect(await inLink(other, key)).toBe(await inLink(page, key));
        for (const dy of [-60, 0, 60]) {
            const place = {x: middle.x, y: middle.y + dy};
            const [theirs, ours] = [await colorAt(other, place), await colorAt(page, place)];
            expect(Math.max(...theirs.map((x, i) => Math.abs(x - ours[i])))).toBeLessThan(3);  // links are rounded
        }
        await other.context().close();
    },
}, {
    name: 'look at the least trusted probe', actions: 3,
    async work(hands) {
        await hands.press(tab(hands, 'Health'));
        const rows = hands.page.getByRole('region', {name: 'Probe health'}).getByRole('row');
        const errors = await Promise.all([1, 2].map(async i => parseFloat((await rows.nth(i).getByRole('cell').nth(1).textContent())!)));
        expect(errors[0]).toBeGreaterThanOrEqual(errors[1]);
        const first = rows.nth(1).getByRole('button');
        const probe = await first.textContent();
        await hands.press(first);
        await hands.press(tab(hands, 'Inspect'));
        await heading(hands, `Probe ${probe}`);
        await says(hands, `error ${errors[0]} %`);
    },
}];

const kHands = {pointer: Pointer, keyboard: Keyboard};

test.each(kTasks.flatMap(task => Object.entries(kHands).map(([by, Kind]) => [`${task.name}, by ${by}`, task, Kind] as const)))(
    '%s', (_, {actions, from = '', isOfSparse = false, work}, Kind) => visit(
        `${server.url}/#volume=${isOfSparse ? sparse : volume}${from}`, async page => {
            await ready(page);
            const hands = new Kind(page);
            await work(hands);
            expect(hands.actions).toBe(actions);
            expect(actions).toBeLessThanOrEqual(kMostActions);
            expect(await page.getByRole('alert').count()).toBe(0);
        }, {refusal: /status of 404/}));  // a preview may be asked for as its bake ends
