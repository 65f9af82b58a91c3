// SPDX-License-Identifier: Apache-2.0
// Lightmaps in three.js against the texels of the file.
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {LayerWeights, lightmapIrradiance, Lightmaps, readLightmaps} from '../src/index.js';
import {Folder, kCourtyard} from '../tests/command.js';
import {kCanRun} from './open_page.js';
import {TestPage} from './three_browser.js';
import type {page as PageOfBrowser, Shown} from './three_lightmap_page.js';

type Window = {page: typeof PageOfBrowser};

const kAlbedo = 0.5;

describe.skipIf(!kCanRun)('lightmaps in three.js', () => {
    const folder = new Folder();
    let opened: TestPage;
    let lightmaps: Lightmaps;
    const base64 = (name: string) => Buffer.from(folder.bytes(name)).toString('base64');
    const bake = (name: string, ...options: string[]) => folder.run(
        'lightmap', kCourtyard, '-o', `${name}.lightmaps`, '--unwrapped', `${name}.glb`, '--samples', '2',
        '--page-size', '256', '--layers', 'sun,sky', '--quiet', ...options);
    beforeAll(async () => {
        bake('court', '--texels-per-meter', '0.8');
        folder.run('export', 'court.lightmaps', '--scene', kCourtyard, '-o', 'lit.glb', '--quiet');
        lightmaps = readLightmaps(folder.bytes('court.lightmaps'));
        opened = await TestPage.open('three_lightmap_page.ts');
    });
    afterAll(async () => {
        folder.remove();
        await opened?.close();
    });

    /** Irradiance between texels, RGB. */
    function irradianceAt(light: Float32Array, instance: number, uv: number[]): number[] {
        const {page, scale, offset} = lightmaps.rectangles[instance];
        const {pageSize} = lightmaps;
        const [x, y] = uv.map((value, axis) => (value * scale[axis] + offset[axis]) * pageSize - 0.5);
        const [left, top] = [Math.floor(x), Math.floor(y)];
        const texel = (column: number, row: number, channel: number) => {
            const clamp = (i: number) => Math.min(Math.max(i, 0), pageSize - 1);
            return light[4 * ((page * pageSize + clamp(row)) * pageSize + clamp(column)) + channel];
        };
        const mix = (a: number, b: number, t: number) => a + (b - a) * t;
        return [0, 1, 2].map(channel => mix(
            mix(texel(left, top, channel), texel(left + 1, top, channel), x - left),
            mix(texel(left, top + 1, channel), texel(left + 1, top + 1, channel), x - left), y - top));
    }

    /** Radiance is albedo / π · E. Objects with several rectangles have none of the name; they are not compared. */
    function compare(shown: Shown[], weights?: LayerWeights): void {
        const light = lightmapIrradiance(lightmaps, weights);
        const instances = new Map(lightmaps.instanceNames.map((name, i) => [name, i]));
        const known = shown.filter(({name}) => lightmaps.instanceNames.filter(each => each === name).length === 1);
        expect(known.length).toBeGreaterThan(40);
        const wanted = known.map(({name, uv}) =>
            irradianceAt(light, instances.get(name)!, uv).map(value => kAlbedo / Math.PI * value));
        const brightest = Math.max(...wanted.flat());
        known.forEach(({name, color}, i) => color.forEach((value, k) => {
            // Filters of textures have 8 bits of place between texels.
            expect(Math.abs(value - wanted[i][k]), name).toBeLessThan(0.01 * brightest);
        }));
    }

    test.each(['court.glb', 'lit.glb'])('show irradiance / π times albedo on the objects of %s', async name => {
        compare(await opened.page.evaluate(([scene, file]) => {
            const {page} = window as unknown as Window;
            return page.show(scene, file);
        }, [base64(name), base64('court.lightmaps')] as const));
    });

    test('follow the weights of layers', async () => {
        compare(await opened.page.evaluate(([scene, file]) => {
            const {page} = window as unknown as Window;
            return page.show(scene, file, {sky: 0.25});
        }, [base64('court.glb'), base64('court.lightmaps')] as const), {sky: 0.25});
    });

    test('of a scene that was unwrapped for others are refused', async () => {
        bake('other', '--texels-per-meter', '0.5');
        const message = await opened.page.evaluate(([scene, file]) => {
            const {page} = window as unknown as Window;
            return page.refuse(scene, file);
        }, [base64('other.glb'), base64('court.lightmaps')] as const);
        expect(message).toContain('the scene was unwrapped for others');
    });

    test('leave no errors or warnings', () => {
        expect(opened.problems).toEqual([]);
    });
});
