// SPDX-License-Identifier: Apache-2.0
// The scene comes first, and anything in it can be selected: by mouse, by name, by keyboard.
import type {Page} from 'playwright-core';
import {afterAll, beforeAll, expect, test} from 'vitest';

import {ballPlace, close, inLink, Place, ready} from './browser';
import {Server} from './server';
import {visit} from './visit';

let server: Server;

beforeAll(async () => {
    server = await new Server().start();
    const scene = await server.uploadCourtyard();
    await server.bake({scene, samples: 128, name: 'court', layers: ['sky', 'emission']});
});
afterAll(async () => {
    await close();
    await server?.end();
});

const button = (page: Page, name: string) => page.getByRole('button', {name, exact: true});
const heading = (page: Page, name: string) => page.getByRole('heading', {name, exact: true});
const fields = async (page: Page, label: string) => Promise.all(
    ['x', 'y', 'z'].map(async axis => Number(await page.getByLabel(`${label} ${axis}`, {exact: true}).inputValue())));
const kBall = 'Position of the ball, metres';
const choose = (page: Page, label: string) => page.getByLabel('Objects of the scene').selectOption({label});

/** The place in the page of the top of an object. */
const topOf = (page: Page, name: string) => page.evaluate(wanted => {
    const {viewer} = (window as any).tetralight;  // eslint-disable-line
    const {meshes: [mesh]} = viewer.model.objects.find((object: {name: string}) => object.name === wanted);
    mesh.geometry.computeBoundingBox();
    const box = mesh.geometry.boundingBox.clone().applyMatrix4(mesh.matrixWorld);
    const top = box.min.clone().add(box.max).multiplyScalar(0.5).setY(box.max.y);
    return viewer.stage.pageFrom(top) as Place;
}, name);

/** The light that an object has: its 28 floats, or its texture. */
const lightOf = (page: Page, name: string) => page.evaluate(wanted => {
    const {model} = (window as any).tetralight.viewer;  // eslint-disable-line
    const mover = model.movers.find(({object}: {object: {name: string}}) => object.name === wanted);
    const {placeSh, lppv} = mover.light.uniforms;
    return [...(placeSh?.value ?? lppv.value.image.data) as ArrayLike<number> & Iterable<number>];
}, name);

async function drag(page: Page, from: Place, x: number, y: number): Promise<void> {
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x + x, from.y + y, {steps: 5});
    await page.mouse.up();
}

test('the page opens on the lit scene, with the ball on a surface in view', () => visit(server.url, async page => {
    await ready(page);
    await heading(page, 'Ball').waitFor();
    const place = await ballPlace(page);
    const {width, height, x, y} = (await page.locator('#view canvas').boundingBox())!;
    expect(place.x).toBeGreaterThan(x);
    expect(place.x).toBeLessThan(x + width);
    expect(place.y).toBeGreaterThan(y);
    expect(place.y).toBeLessThan(y + height);
    const {radius, distance, before, below} = await page.evaluate(({x, y}) => {
        const {viewer: {stage, model}, inspect: {object: {ball}}} = (window as any).tetralight;  // eslint-disable-line
        const caster = stage.rayAt(x, y);
        const before = caster.intersectObject(model.root)[0]?.distance ?? Infinity;
        const distance = ball.position.distanceTo(stage.camera.position);
        caster.set(ball.position, ball.position.clone().set(0, -1, 0));
        return {radius: ball.scale.x, distance, before, below: caster.intersectObject(model.root)[0].distance};
    }, place);
    expect(before).toBeGreaterThan(distance - radius);  // nothing is before it
    expect(below).toBeGreaterThanOrEqual(radius);
    expect(below).toBeLessThan(1.1 * radius);

    const areCellsShown = () => page.evaluate(() => (window as any).tetralight.viewer.marks.lines.group.visible as boolean);  // eslint-disable-line
    expect(await areCellsShown()).toBe(false);
    await page.getByRole('tab', {name: 'View'}).click();
    await page.getByLabel('All cells').check();
    expect(await areCellsShown()).toBe(true);
    expect(await inLink(page, 'shown')).toBe('cells');
    await page.reload();
    await ready(page);
    expect(await areCellsShown()).toBe(true);
}));

test('an object that moves is dragged, and its light changes', () => visit(
    `${server.url}/#eye=0,22,8.01&target=0,0,8&hidden=probes`, async page => {
        await ready(page);
        const ball = await fields(page, kBall);
        const before = await lightOf(page, 'sphere_sun_front');
        await drag(page, await topOf(page, 'sphere_sun_front'), 60, -120);
        await heading(page, 'sphere_sun_front').waitFor();
        await page.getByText('It moves').waitFor();
        const label = 'Position of sphere_sun_front, metres';
        const moved = await fields(page, label);
        expect(await lightOf(page, 'sphere_sun_front')).not.toEqual(before);
        await button(page, 'Put it back').click();
        expect(await lightOf(page, 'sphere_sun_front')).toEqual(before);
        const [x, y, z] = await fields(page, label);
        expect(moved[0]).toBeGreaterThan(x);
        expect(moved[1]).toBeCloseTo(y, 2);  // on its level
        expect(moved[2]).toBeLessThan(z);
        await choose(page, 'Ball');
        expect(await fields(page, kBall)).toEqual(ball);
    }));

test('a static object says why it cannot move, and the ball is put on it', () => visit(
    `${server.url}/#eye=0,22,8.01&target=0,0,8&hidden=probes`, async page => {
        await ready(page);
        const top = await topOf(page, 'box_blue');
        await page.mouse.click(top.x, top.y);
        await heading(page, 'box_blue').waitFor();
        await page.getByText('It cannot move here').waitFor();
        await page.getByText(/^(Hull c|C)ell \d+$/).waitFor();
        await button(page, 'Put the ball here').click();
        await heading(page, 'Ball').waitFor();
        const there = await ballPlace(page);
        expect(Math.hypot(there.x - top.x, there.y - top.y)).toBeLessThan(20);

        // The ground, by a double click.
        const ground = {x: top.x, y: top.y + 90};
        await page.mouse.dblclick(ground.x, ground.y);
        await heading(page, 'Ball').waitFor();
        const next = await ballPlace(page);
        expect(Math.hypot(next.x - ground.x, next.y - ground.y)).toBeLessThan(20);
    }));

test('all is selected, moved and framed by keyboard', () => visit(server.url, async page => {
    await ready(page);
    await page.getByLabel('Find an object').fill('beam');
    await page.getByLabel('Find an object').press('Tab');
    await page.keyboard.press('ArrowDown');
    await heading(page, 'beam_long').waitFor();
    await page.getByText(/m, \d+ × \d+ × \d+ points/).waitFor();  // its proxy volume
    const label = 'Position of beam_long, metres';
    const start = await fields(page, label);
    await page.locator('#view canvas').focus();
    await page.keyboard.press('Alt+PageUp');
    await expect.poll(async () => (await fields(page, label))[1]).toBeCloseTo(start[1] + 0.25, 3);
    await page.keyboard.press('Alt+ArrowRight');
    await expect.poll(async () => {
        const [x, , z] = await fields(page, label);
        return Math.hypot(x - start[0], z - start[2]);
    }).toBeCloseTo(0.25, 3);

    const targetOf = () => page.evaluate(
        () => (window as any).tetralight.viewer.stage.controls.target.toArray() as number[]);  // eslint-disable-line
    await page.keyboard.press('f');
    const framed = await targetOf();
    (await fields(page, label)).forEach((value, axis) => expect(framed[axis]).toBeCloseTo(value, 2));
    await page.keyboard.press('Home');
    expect(await targetOf()).not.toEqual(framed);
    await page.keyboard.press('Escape');
    await heading(page, 'Nothing is selected').waitFor();
    await page.keyboard.press('?');
    await heading(page, 'Keys and mouse').waitFor();
    await page.keyboard.press('Escape');
    await heading(page, 'Keys and mouse').waitFor({state: 'hidden'});
}));

test('a probe says what it is, under the pointer and with the focus', () => visit(server.url, async page => {
    await ready(page);
    const words = /^probe \d+, validity [\d.]+, error .+$/;
    const link = page.locator('.answer button').first();
    await link.focus();
    const name = page.locator('.labels .name');
    expect(await name.textContent()).toMatch(words);
    expect(await link.getAttribute('title')).toMatch(words);
    await page.getByLabel('Find an object').focus();
    await name.waitFor({state: 'detached'});

    // The probe that is alone before the sky is not hidden.
    const {probe, place} = await page.evaluate(() => {
        const {viewer: {stage, volume}} = (window as any).tetralight;  // eslint-disable-line
        const [probe] = [...Array(volume.probes.probeCount).keys()]
            .map(probe => ({probe, at: stage.pageFrom(stage.camera.position.clone().fromArray(volume.positions, 3 * probe)),
                            height: volume.positions[3 * probe + 1] as number}))
            .filter(({at}) => at.isInFront && at.x > 40 && at.x < innerWidth - 400 && at.y > 80)
            .sort((a, b) => b.height - a.height);
        return {probe: probe.probe, place: probe.at as Place};
    });
    await page.mouse.move(place.x, place.y);
    await name.waitFor();
    expect(await name.textContent()).toContain(`probe ${probe},`);
    await page.mouse.click(place.x, place.y);
    await heading(page, `Probe ${probe}`).waitFor();
    await page.mouse.move(place.x + 60, place.y + 40);
    await page.getByText('Light in numbers').click();
    for (const name of ['above', 'below']) await page.getByRole('rowheader', {name, exact: true}).waitFor();
}));
