// SPDX-License-Identifier: Apache-2.0
// Objects of WebGPURenderer, by its WebGL 2 backend, against the light of the volume.
import {join} from 'node:path';

import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {bundle, kCanTest, LitSquares, TestPage} from './three_browser.js';
import {compareSpheres, compareSquares} from './three_compare.js';
import type {Kind} from './three_squares.js';
import type {page as PageOfBrowser} from './three_tsl_page.js';

type Window = {page: typeof PageOfBrowser};

describe.skipIf(!kCanTest)('as nodes of three.js', () => {
    let lit: LitSquares;
    let opened: TestPage;
    beforeAll(async () => {
        lit = new LitSquares();
        opened = await TestPage.open('three_tsl_page.ts');
        expect(await opened.page.evaluate(() => (window as unknown as Window).page.begin())).toBe('WebGL 2');
    });
    afterAll(async () => opened?.close());

    test.each([
        ['meshes', 'standard'], ['meshes', 'physical'], ['meshes', 'lambert'], ['meshes', 'phong'],
        ['instances', 'standard'], ['instances', 'phong'], ['batch', 'lambert'], ['skin', 'lambert'],
    ] as ['meshes' | 'instances' | 'batch' | 'skin', Kind][])('%s of %s node material have the light of probes', async (way, kind) => {
        const colors = await opened.page.evaluate(([bytes, shade, given, all]) => {
            const {page} = window as unknown as Window;
            return page[shade](page.open(bytes), given, all);
        }, [lit.base64, way, kind, lit.squares] as const);
        compareSquares(lit, kind, colors);
    });

    test.each([['standard', false], ['standard', true], ['lambert', false]] as [Kind, boolean][])(
        'spheres of %s node material have the light of probes in 8 bits (instances: %s)', async (kind, isInstanced) => {
            const exposure = 1 / lit.brightest;
            const spheres = await opened.page.evaluate(([bytes, given, all, factor, instanced]) => {
                const {page} = window as unknown as Window;
                return page.spheres(page.open(bytes), given, all, factor, instanced);
            }, [lit.base64, kind, lit.squares, exposure, isInstanced] as const);
            compareSpheres(lit, kind, exposure, spheres);
        });

    test('a character has the light at its anchor, where its bone is', async () => {
        compareSquares(lit, 'lambert', await opened.page.evaluate(([bytes, all]) => {
            const {page} = window as unknown as Window;
            return page.skin(page.open(bytes), 'lambert', all, true);
        }, [lit.base64, lit.squares] as const));
    });

    test('instances that move take new light, and no others are looked for', async () => {
        const {colors, counts} = await opened.page.evaluate(([bytes, all]) => {
            const {page} = window as unknown as Window;
            return page.moving(page.open(bytes), all);
        }, [lit.base64, lit.squares] as const);
        const all = 50 * lit.squares.length;
        expect(counts).toEqual([all, lit.squares.length, all / 2]);
        for (const each of colors) compareSquares(lit, 'lambert', each);
    });

    test('objects follow the weights of layers', async () => {
        const square = lit.squares[0];
        const [before, after] = await opened.page.evaluate(([bytes, given]) => {
            const {page} = window as unknown as Window;
            return page.dim(page.open(bytes), given, {sky: 0.25});
        }, [lit.base64, square] as const);
        const full = lit.radiance(square);
        before.forEach((value, k) => expect(value).toBeCloseTo(full[k], 2));
        lit.volume.setWeights({sky: 0.25});
        const dimmed = lit.radiance(square);
        lit.volume.setWeights({sky: 1});
        after.forEach((value, k) => expect(value).toBeCloseTo(dimmed[k], 2));
        expect(after[0]).toBeLessThan(before[0]);
    });

    test('materials of WebGLRenderer become node materials', async () => {
        const colors = await opened.page.evaluate(([bytes, all]) => {
            const {page} = window as unknown as Window;
            page.useClassicMaterials();
            return page.meshes(page.open(bytes), 'lambert', all);
        }, [lit.base64, lit.squares] as const);
        compareSquares(lit, 'lambert', colors);
    });

    test('the page has no errors or warnings', () => {
        // three.js warns of a member of its own when it copies a physical material.
        expect(opened.problems.filter(text => !text.includes('iridescenceThicknessRange'))).toEqual([]);
    });
});

test('users of WebGLRenderer do not load WebGPURenderer', async () => {
    const classic = await bundle(join(__dirname, 'three_page.ts'));
    expect(classic).not.toContain('NodeBuilder');
});
