// SPDX-License-Identifier: Apache-2.0
// What holds of objects by each renderer of three.js.
import {beforeAll, describe, expect, test} from 'vitest';

import type {LitSquares, TestPage} from './three_browser.js';
import {compareSpheres, compareSquares} from './three_compare.js';
import {compareWithRenderer, renderSpheres} from './three_renderer.js';
import type {Kind, Squares} from './three_squares.js';

type Window = {page: Squares};

/** A kind of material, and whether spheres are instances. */
export type Spheres = [kind: Kind, isInstanced: boolean];

/** Tests the page that is open when they run. `measured` spheres are compared with the volume, `pictured` ones with pictures. */
export function testObjects(opened: () => {lit: LitSquares, page: TestPage['page']}, measured: Spheres[],
                            pictured: Spheres[]): void {
    test.each([
        ['meshes', 'standard'], ['meshes', 'physical'], ['meshes', 'lambert'], ['meshes', 'phong'],
        ['instances', 'standard'], ['instances', 'phong'], ['batch', 'lambert'], ['skin', 'lambert'],
    ] as ['meshes' | 'instances' | 'batch' | 'skin', Kind][])('%s of %s material have the light of probes', async (way, kind) => {
        const {lit, page} = opened();
        const colors = await page.evaluate(([bytes, shade, given, all]) => {
            const {page} = window as unknown as Window;
            return page[shade](page.open(bytes), given, all);
        }, [lit.base64, way, kind, lit.squares] as const);
        compareSquares(lit, kind, colors);
    });

    test.each(measured)('spheres of %s material have the light of probes in 8 bits (instances: %s)', async (kind, isInstanced) => {
        const {lit, page} = opened();
        const exposure = 1 / lit.brightest;
        const spheres = await page.evaluate(([bytes, given, all, factor, instanced]) => {
            const {page} = window as unknown as Window;
            return page.spheres(page.open(bytes), given, all, factor, instanced);
        }, [lit.base64, kind, lit.squares, exposure, isInstanced] as const);
        compareSpheres(lit, kind, exposure, spheres);
    });

    describe('spheres beside those of `tetralight render`', () => {
        const exposure = () => 1 / opened().lit.brightest;
        let ours: number[][][];
        beforeAll(() => { ours = renderSpheres(opened().lit, exposure()); });

        test.each(pictured)(
            'of %s material differ by no more than they should (instances: %s)', async (kind, isInstanced) => {
                const {lit, page} = opened();
                const theirs = await page.evaluate(([bytes, given, all, factor, instanced]) => {
                    const {page} = window as unknown as Window;
                    return page.views(page.open(bytes), given, all, factor, instanced);
                }, [lit.base64, kind, lit.squares, exposure(), isInstanced] as const);
                compareWithRenderer(kind, ours, theirs);
            });
    });

    test('a character has the light at its anchor, where its bone is', async () => {
        const {lit, page} = opened();
        compareSquares(lit, 'lambert', await page.evaluate(([bytes, all]) => {
            const {page} = window as unknown as Window;
            return page.skin(page.open(bytes), 'lambert', all, true);
        }, [lit.base64, lit.squares] as const));
    });

    test('instances that move take new light, and no others are looked for', async () => {
        const {lit, page} = opened();
        const {colors, counts} = await page.evaluate(([bytes, all]) => {
            const {page} = window as unknown as Window;
            return page.moving(page.open(bytes), all);
        }, [lit.base64, lit.squares] as const);
        const all = 50 * lit.squares.length;
        expect(counts).toEqual([all, lit.squares.length, all / 2, lit.squares.length]);
        for (const each of colors) compareSquares(lit, 'lambert', each);
    });

    test('objects follow the weights of layers', async () => {
        const {lit, page} = opened();
        const square = lit.squares[0];
        const [before, after] = await page.evaluate(([bytes, given]) => {
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
}
