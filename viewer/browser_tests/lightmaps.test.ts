// SPDX-License-Identifier: Apache-2.0
// Lightmaps of the courtyard in three.js (examples/threejs) against those of `tetralight render`.
import {afterAll, beforeAll, expect, test} from 'vitest';

import {close} from './browser';
import {LightmapPictures, quantile} from './lightmap_pictures';
import {kCourtyard, run} from './server';
import {visit} from './visit';

const kPageSize = 256;  // several pages

let pictures: LightmapPictures;

beforeAll(async () => {
    pictures = await new LightmapPictures().start({texelsPerMeter: 5, samples: 16, pageSize: kPageSize});
});
afterAll(async () => {
    await close();
    pictures?.end();
});

// Each of both pictures rounds by half a step of 255. Chromium's rasterizer moves corners by up to
// 1/16 pixel, which is a second step where light changes by 16 steps a pixel: at hardly any.
const kStepsOfHalves = 2;
const kShareOfHalves = 0.999;
// RGBM rounds the colour, too, by half a step of a texel that is at least as bright as what is shown;
// tone mapping stretches steps of dark pixels by up to 3/2.
const kStepsOfRgbm = kStepsOfHalves + 1;

test.each(['camera', 'camera_interior'])('halves show the same light, seen by %s', async camera => {
    const shown = await pictures.show('halves', camera);
    const counts = await pictures.differences(shown, camera);
    expect(quantile(counts, kShareOfHalves)).toBeLessThanOrEqual(kStepsOfHalves);
    expect(counts.reduce((sum, count) => sum + count)).toBeGreaterThan(60_000);  // half of the picture
});

test.each(['camera', 'camera_interior'])('RGBM shows the same light, seen by %s', async camera => {
    const shown = await pictures.show('rgbm', camera);
    const counts = await pictures.differences(shown, camera);
    expect(quantile(counts, 0.99)).toBeLessThanOrEqual(kStepsOfRgbm);
});

test('the comparison sees lightmaps that lie half a texel beside their place', async () => {
    const shown = await pictures.show('halves', 'camera_interior');
    await shown.evaluate((picture, distance) => picture.shift(distance), 0.5 / kPageSize);
    const counts = await pictures.differences(shown, 'camera_interior');
    expect(quantile(counts, 0.99)).toBeGreaterThan(kStepsOfRgbm);
});

test('each page is uploaded once, for all objects', async () => {
    const pages = JSON.parse(run('info', pictures.path('court.lightmaps'), '--json')).pages as number;
    expect(pages).toBeGreaterThan(1);
    for (const light of ['halves', 'rgbm'] as const) {
        const shown = await pictures.show(light, 'camera');
        expect(await shown.evaluate(picture => picture.radiance() && picture.textures())).toBe(pages);
    }
});

test('lights shine that are not baked', async () => {
    const baked = await pictures.show('rgbm', 'camera');
    expect(await baked.evaluate(picture => picture.lights)).toEqual([]);
    run('export', pictures.path('court.lightmaps'), '--scene', kCourtyard, '-o', pictures.path('mixed.glb'));
    const mixed = await pictures.show('rgbm', 'camera', {scene: 'mixed.glb'});
    expect(await mixed.evaluate(picture => picture.lights)).toEqual(['sun']);
});

test('the example shows the scene', () => visit(pictures.example({scene: 'lit.glb', halves: 'lit.ktx2'}), async page => {
    await page.waitForFunction(() => document.body.dataset.state === 'ready');
    const picture = await page.locator('canvas').screenshot();
    expect(picture.length).toBeGreaterThan(20_000);  // bytes of a PNG; of one colour it has 3000
    expect(await page.textContent('#message')).toBe('');
}));

test('the example says why it shows nothing', async () => {
    run('lightmap', kCourtyard, '-o', pictures.path('one.lightmaps'), '--texels-per-meter', '1', '--samples', '1');
    run('export', pictures.path('one.lightmaps'), '-o', pictures.path('one.ktx2'));
    const cases = {
        [pictures.example({scene: 'none.glb'})]: /none\.glb.*404/,
        [pictures.example({scene: 'lit.glb', halves: 'none.ktx2'})]: /none\.ktx2: 404/,
        [pictures.example({scene: 'lit.glb', halves: 'lit.glb'})]: /lit\.glb: .*KTX/,
        [pictures.example({scene: 'lit.glb', halves: 'one.ktx2'})]: /one\.ktx2 has 1 page/,
    };
    for (const [address, reason] of Object.entries(cases)) {
        await visit(address, async page => {
            await page.waitForFunction(() => document.getElementById('message')!.textContent !== '');
            expect(await page.textContent('#message')).toMatch(reason);
        }, {refusal: /404/});
    }
});
