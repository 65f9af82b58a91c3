// SPDX-License-Identifier: Apache-2.0
// What the page shows, and how it is told to.
import {readFileSync} from 'node:fs';

import {afterAll, beforeAll, expect, test} from 'vitest';

import {meteredExposure} from '../src/view/exposure';
import {addressOf, close, colorAt, inLink, open, ready} from './browser';
import {Server} from './server';
import {visit} from './visit';

let server: Server;
let volume: string;

beforeAll(async () => {
    server = await new Server().start();
    const scene = await server.uploadCourtyard();
    volume = await server.bake({scene, samples: 32, name: 'court', layers: ['sun', 'sky', 'emission']});
});
afterAll(async () => {
    await close();
    await server?.end();
});

test('the page shows the newest volume with the scene of its bake', () => visit(server.url, async page => {
    await ready(page);
    expect(await page.textContent('#status')).toBe('courtyard · court: 255 probes');
    expect(await page.textContent('#panel-view .facts')).toBe('255 probes, 1 367 tetrahedra');
}));

test('the view is saved as a picture', () => visit(server.url, async page => {
    await ready(page);
    const waiting = page.waitForEvent('download');
    await page.getByRole('button', {name: 'Save picture'}).click();
    const saved = await waiting;
    expect(saved.suggestedFilename()).toBe('courtyard.png');
    const png = readFileSync(await saved.path());
    const size = await page.locator('#view canvas').evaluate(({clientWidth, clientHeight}) => [clientWidth, clientHeight]);
    expect([png.readUInt32BE(16), png.readUInt32BE(20)]).toEqual(size);
    // A picture of one color is a fiftieth of this.
    expect(png.length).toBeGreaterThan(20_000);
}));

test('a link holds the view', () => visit(server.url, async page => {
    await ready(page);
    await page.click('#tab-inspect');
    const place = page.getByLabel('Position of the ball, metres x');
    await place.fill('4.5');
    await place.press('Tab');
    await page.focus('#view canvas');
    await page.keyboard.press('ArrowLeft');
    await page.getByRole('button', {name: 'Copy link'}).click();
    expect(await inLink(page, 'volume')).toBe(volume);
    const second = await open(await addressOf(page));
    expect(await second.getByRole('tab', {name: 'Inspect'}).getAttribute('aria-selected')).toBe('true');
    expect(await second.getByLabel('Position of the ball, metres x').inputValue()).toBe('4.5');
    await second.getByRole('button', {name: 'Copy link'}).click();
    const before = await inLink(second, 'eye');
    expect(before).toBe(await inLink(page, 'eye'));
    await second.focus('#view canvas');
    await second.keyboard.press('ArrowUp');
    await expect.poll(() => inLink(second, 'eye')).not.toBe(before);  // without being asked
    await second.context().close();
}));

test('the exposure is that of the light itself, and needs no shader of its own', () => visit(server.url + '/#tab=view', async page => {
    await ready(page);
    const {found, light, programs} = await page.evaluate(async () => {
        const {stage} = (window as any).tetralight.viewer;  // eslint-disable-line
        const {renderer} = stage;
        const setTarget = renderer.setRenderTarget;
        let Target: any;  // eslint-disable-line
        renderer.setRenderTarget = (target: object | null) => {
            if (target !== null) Target ??= target.constructor;
            setTarget(target);
        };
        stage.drawNow();
        const programs = [renderer.info.programs.length];
        await stage.exposeItself();
        programs.push(renderer.info.programs.length);
        stage.scene.traverse((object: any) => {  // eslint-disable-line
            if (object.userData.isMark || object.material?.toneMapped === false) object.visible = false;
        });
        const [width, height] = [64, 36];
        const kFloat = 1015;
        setTarget(new Target(width, height, {type: kFloat}));  // linear, not tone-mapped
        stage.render();
        const pixels = new Float32Array(4 * width * height);
        renderer.readRenderTargetPixels(renderer.getRenderTarget(), 0, 0, width, height, pixels);
        setTarget(null);
        return {found: stage.exposure, light: [...pixels], programs};
    });
    expect(programs[1]).toBe(programs[0]);
    // Panes are blended after the tone mapping.
    expect(Math.abs(found / meteredExposure(light)! - 1)).toBeLessThan(0.02);
}));

test('the weight of a layer changes the light of probes at once', () => visit(server.url + '/#tab=view', async page => {
    await ready(page);
    const light = () => page.evaluate(() => {
        const {viewer} = (window as any).tetralight;  // eslint-disable-line
        return (viewer.volume.probes.irradiance as Float32Array).reduce((sum, x) => sum + Math.abs(x), 0);
    });
    const before = await light();
    for (const layer of ['sun', 'sky', 'emission']) await page.getByLabel(layer, {exact: true}).fill('0');
    const rest = await light();
    await page.getByLabel('sky', {exact: true}).fill('2');
    expect(rest).toBeLessThan(0.1 * before);
    expect(await light()).toBeGreaterThan(2 * rest);
    await page.getByRole('button', {name: 'Copy link'}).click();
    expect(await addressOf(page)).toContain('w.sun=0');
}));

test('without a weight left, scene and sky are black', () => visit(server.url + '/#tab=view', async page => {
    await ready(page);
    const brightest = () => page.evaluate(async () => {
        const {stage} = (window as any).tetralight.viewer;  // eslint-disable-line
        return Math.max(...(await stage.light()).filter((_: number, i: number) => i % 4 < 3));
    });
    const before = await brightest();
    for (const name of await page.locator('#panel-view input[type=range]').all()) {
        if (await name.getAttribute('max') === '4' && await name.getAttribute('min') === '0') await name.fill('0');
    }
    expect(before).toBeGreaterThan(0.5);
    expect(await brightest()).toBeLessThan(1e-3);
}));

test('light that is stored is what the page names', () => visit(server.url + '/#tab=view', async page => {
    await ready(page);
    await page.getByLabel('sun', {exact: true}).fill('0.5');
    await page.getByRole('button', {name: 'Keep as a volume'}).click();
    await page.locator('#status', {hasText: 'The light is stored'}).waitFor();
    const {volumes} = await server.request<{volumes: {id: string}[]}>('GET', '/v1/volumes');
    const made = volumes.find(({id}) => id !== volume)!.id;
    expect(await page.getByLabel('Probe volume').inputValue()).toBe(made);
    expect(await inLink(page, 'volume')).toBe(made);
    await page.locator('#status', {hasText: ': 255 probes'}).waitFor();  // news do not stay
    await server.request('DELETE', `/v1/volumes/${made}`);
}));

test('a click in the table of health selects the probe in 3D', () => visit(server.url + '/#tab=health', async page => {
    await ready(page);
    const first = page.getByRole('button', {name: /^Show probe/}).first();
    const name = await first.getAttribute('aria-label');
    await first.click();
    const selected = await page.evaluate(
        () => (window as unknown as {tetralight: {viewer: {marks: {selectedProbe: number}}}}).tetralight.viewer.marks.selectedProbe);
    expect(name).toBe(`Show probe ${selected}`);
    expect(await page.locator('tr[aria-current=true] button').getAttribute('aria-label')).toBe(name);
    const place = await page.evaluate(() => {
        const {viewer} = (window as any).tetralight;  // eslint-disable-line
        const {stage, marks: {ring}} = viewer;
        const right = ring.position.clone().set(1, 0, 0).applyQuaternion(stage.camera.quaternion);
        return stage.pageFrom(ring.position.clone().addScaledVector(right, 1.6 * ring.scale.x)) as {x: number; y: number};
    });
    const [red, green, blue] = await colorAt(page, place);
    expect(red).toBeGreaterThan(200);
    expect(green).toBeGreaterThan(140);
    expect(blue).toBeLessThan(90);
}));
