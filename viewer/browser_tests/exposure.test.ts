// SPDX-License-Identifier: Apache-2.0
// Exposure and tone mapping, by the names of the controls.
import {afterAll, beforeAll, expect, test} from 'vitest';

import {kToneMappings, shownColor} from '../src/view/tone_mapping';
import {addressOf, close, colorAt, inLink, open, ready} from './browser';
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

test('the slider is in stops above what was metered, and a link keeps both', () => visit(server.url + '/#tab=view', async page => {
    await ready(page);
    const slider = page.getByLabel('Exposure, stops');
    expect(await slider.inputValue()).toBe('0');
    await page.getByText('As metered.').waitFor();
    const metered = Number(await inLink(page, 'exposure'));
    await slider.fill('2');
    await page.getByText('4 times as bright as metered.').waitFor();
    await expect.poll(() => inLink(page, 'stops')).toBe('2');
    expect(Number(await inLink(page, 'exposure')) / metered).toBeCloseTo(4, 2);
    const second = await open(await addressOf(page));
    expect(await second.getByLabel('Exposure, stops').inputValue()).toBe('2');
    await second.getByRole('button', {name: 'Reset exposure'}).click();
    expect(await second.getByLabel('Exposure, stops').inputValue()).toBe('0');
    await second.getByRole('button', {name: 'Copy link'}).click();
    expect(Number(await inLink(second, 'exposure')) / metered).toBeCloseTo(1, 2);
    await second.context().close();
}));

test('the view shows light by its tone mapping, as swatches do', () => visit(
    server.url + '/#tab=view&exposure=1&hidden=scene,probes', async page => {
        await ready(page);
        const radiance = [0.9, 0.5, 0.2];
        await page.evaluate(color => {
            (window as any).tetralight.viewer.stage.sky.radiance.fromArray(color);  // eslint-disable-line
        }, radiance);
        const {x, y} = (await page.locator('#view canvas').boundingBox())!;
        for (const {name, toneMapping} of kToneMappings) {
            await page.getByLabel('Tone mapping').selectOption(name);
            const seen = await colorAt(page, {x: x + 20, y: y + 100});
            shownColor(radiance, 1, toneMapping).forEach(
                (value, channel) => expect(Math.abs(seen[channel] - value)).toBeLessThanOrEqual(2));
        }
    }));

test('views of any brightness are metered, and a black one keeps its exposure', () => visit(
    server.url + '/#tab=view&exposure=1&stops=6&hidden=scene,probes&object=0,1000,0', async page => {
        await ready(page);
        const see = (radiance: number) => page.evaluate(value => {
            const {viewer: {stage}} = (window as any).tetralight;  // eslint-disable-line
            stage.sky.radiance.setScalar(value);
        }, radiance);
        const exposure = () => page.evaluate(() => (window as any).tetralight.viewer.stage.exposure as number);  // eslint-disable-line
        const {x, y} = (await page.locator('#view canvas').boundingBox())!;
        const grey = shownColor([0.18, 0.18, 0.18], 1, kToneMappings[0].toneMapping)[0];
        for (const radiance of [1e6, 1, 1e-6]) {
            await see(radiance);
            await page.getByRole('button', {name: 'Meter this view'}).click();
            await expect.poll(async () => await exposure() * radiance).toBeCloseTo(0.18, 2);
            const seen = await colorAt(page, {x: x + 20, y: y + 100});
            expect(Math.abs(seen[1] - grey), String(radiance)).toBeLessThanOrEqual(3);
        }
        expect(await page.getByLabel('Exposure, stops').inputValue()).toBe('0');
        await see(0);
        const before = await exposure();
        await page.getByRole('button', {name: 'Meter this view'}).click();
        await page.getByText('Nothing in this view is lit').waitFor();
        expect(await exposure()).toBe(before);
    }));

test('the tone mapping is in the link', () => visit(server.url + '/#tab=view', async page => {
    await ready(page);
    expect(await inLink(page, 'tone')).toBeNull();
    await page.getByLabel('Tone mapping').selectOption({label: 'AgX: soft highlights'});
    await expect.poll(() => inLink(page, 'tone')).toBe('agx');
    const second = await open(await addressOf(page));
    expect(await second.getByLabel('Tone mapping').inputValue()).toBe('agx');
    await second.context().close();
}));

test('a link to a volume that is gone says so, and leads to the newest', () => visit(
    `${server.url}/#volume=${'a'.repeat(64)}`, async page => {
        await ready(page);
        await page.getByText('The volume "aaaaaaaa" is not on this server any more').waitFor();
        await page.getByRole('button', {name: 'Open the newest'}).click();
        await page.getByText('courtyard · court: 255 probes').waitFor();
        expect(await page.locator('#banner').isHidden()).toBe(true);
    }, {refusal: /404/}));
