// SPDX-License-Identifier: Apache-2.0
// Objects of three.js against the light of the volume.
import {existsSync} from 'node:fs';
import {join} from 'node:path';

import {Browser, chromium, Page} from 'playwright-core';
import {build, Rollup} from 'vite';
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {irradiance, read, Volume} from '../src/index.js';
import {Folder, kCommand, kCourtyard} from '../tests/command.js';
import {makePositions, makeRandom} from '../tests/random.js';
import type {Kind, page as PageOfBrowser} from './page.js';

const kChromium = process.env.CHROMIUM ?? '/usr/bin/chromium';
const kRoot = join(__dirname, '..');
const kAlbedo = 0.5;
const kCount = 40;

type Window = {page: typeof PageOfBrowser};

const folder = new Folder();
let browser: Browser | undefined;
afterAll(async () => {
    folder.remove();
    await browser?.close();
});

async function openPage(): Promise<Page> {
    const built = await build({
        root: kRoot, configFile: false, logLevel: 'error', define: {'process.env.NODE_ENV': '"production"'},
        build: {write: false, target: 'es2022',
                lib: {entry: join(__dirname, 'page.ts'), formats: ['iife'], name: 'unused', fileName: 'page'}},
    }) as Rollup.RollupOutput[];
    browser = await chromium.launch({executablePath: kChromium, args: [
        '--no-sandbox', '--disable-dev-shm-usage', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
        '--ignore-gpu-blocklist']});
    const page = await (await browser.newContext()).newPage();
    await page.addScriptTag({content: (built[0].output[0] as Rollup.OutputChunk).code});
    return page;
}

describe.skipIf(kCommand === '' || kCourtyard === '' || !existsSync(kChromium))('in three.js', () => {
    let volume: Volume;
    let file: string;
    let page: Page;
    let squares: {position: number[]; normal: number[]}[];
    beforeAll(async () => {
        const bytes = folder.bake(undefined, '--layers', 'sun,sky');
        volume = read(bytes);
        file = Buffer.from(bytes).toString('base64');
        page = await openPage();
        const positions = makePositions(volume, 2 * kCount, 50);
        const random = makeRandom(51);
        squares = Array.from({length: kCount}, (_, i) => {
            const normal = [random() - 0.5, random() - 0.5, random() - 0.5];
            const length = Math.hypot(...normal);
            return {position: [...positions.subarray(6 * i + 3, 6 * i + 6)], normal: normal.map(x => x / length)};
        }).filter(({position}) => Math.hypot(...position) < 1000);
    });

    /** Radiance of a square: albedo / π · E, and never negative. */
    const expected = ({position, normal}: {position: number[]; normal: number[]}) =>
        irradiance(volume.light(position).sh, normal).map(value => kAlbedo / Math.PI * Math.max(value, 0));

    // Standard material reflects the less diffuse light, the more its specular lobe reflects of all directions: 1.4 %.
    const tolerance = (kind: Kind) => kind === 'standard' ? 0.015 : 1e-3;

    function compare(kind: Kind, colors: number[][]): void {
        expect(colors).toHaveLength(squares.length);
        const largest = Math.max(...squares.flatMap(expected));
        colors.forEach((color, i) => {
            const want = expected(squares[i]);
            color.forEach((value, k) => expect(Math.abs(value - want[k]), `square ${i}`).toBeLessThan(tolerance(kind) * largest));
        });
    }

    test.each([
        ['meshes', 'standard'], ['meshes', 'physical'], ['meshes', 'lambert'], ['meshes', 'phong'],
        ['instances', 'standard'], ['instances', 'phong'], ['batch', 'lambert'], ['skin', 'lambert'],
    ] as ['meshes' | 'instances' | 'batch' | 'skin', Kind][])('%s of %s material have the light of probes', async (way, kind) => {
        const colors = await page.evaluate(([bytes, shade, given, all]) => {
            const {page: tools} = window as unknown as Window;
            return tools[shade](tools.open(bytes), given, all);
        }, [file, way, kind, squares] as const);
        compare(kind, colors);
    });

    test('the grid of three.js has the light at the centers of its cells', async () => {
        // three.js reads it half a cell before the surface: squares lie half a cell behind the centers.
        const [low, high, resolution] = [[-6, 0, -6], [6, 4, 6], [6, 4, 5] as [number, number, number]];
        const step = resolution.map((count, axis) => (high[axis] - low[axis]) / count);
        const random = makeRandom(52);
        const cells = Array.from({length: kCount}, () => {
            const axis = Math.floor(3 * random());
            const normal = [0, 0, 0];
            normal[axis] = random() < 0.5 ? -1 : 1;
            const center = resolution.map((count, i) => low[i] + (Math.floor(count * random()) + 0.5) * step[i]);
            return {normal, center, position: center.map((x, i) => x - normal[i] * step[i] / 2)};
        });
        const colors = await page.evaluate(([bytes, all, from, to, counts]) => {
            const {page: tools} = window as unknown as Window;
            return tools.grid(tools.open(bytes), all, from, to, counts);
        }, [file, cells, low, high, resolution] as const);
        const wanted = cells.map(({center, normal}) => expected({position: center, normal}));
        const largest = Math.max(...wanted.flat());
        colors.forEach((color, i) => {
            color.forEach((value, k) => expect(Math.abs(value - wanted[i][k]), `cell ${i}`).toBeLessThan(2e-3 * largest));
        });
    });

    test('objects follow the weights of layers', async () => {
        const square = squares[0];
        const [before, after] = await page.evaluate(([bytes, given]) => {
            const {page: tools} = window as unknown as Window;
            return tools.dim(tools.open(bytes), given, {sky: 0.25});
        }, [file, square] as const);
        const full = expected(square);
        before.forEach((value, k) => expect(value).toBeCloseTo(full[k], 2));
        volume.setWeights({sky: 0.25});
        const dimmed = expected(square);
        volume.setWeights({sky: 1});
        after.forEach((value, k) => expect(value).toBeCloseTo(dimmed[k], 2));
        expect(after[0]).toBeLessThan(before[0]);
    });
});
