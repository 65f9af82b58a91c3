// SPDX-License-Identifier: Apache-2.0
// Objects of WebGLRenderer against the light of the volume.
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {irradiance, kCoefficients} from '../src/index.js';
import {makeRandom} from '../tests/random.js';
import {kCanRun} from './open_page.js';
import {LitSquares, TestPage} from './three_browser.js';
import {testObjects} from './three_object_tests.js';
import type {page as PageOfBrowser} from './three_page.js';

type Window = {page: typeof PageOfBrowser};
const kCount = 40;

describe.skipIf(!kCanRun)('in three.js', () => {
    let lit: LitSquares;
    let opened: TestPage;
    beforeAll(async () => {
        lit = new LitSquares();
        opened = await TestPage.open('three_page.ts');
    });
    afterAll(async () => {
        lit?.folder.remove();
        await opened?.close();
    });

    testObjects(() => ({lit, page: opened.page}),
                [['standard', false], ['physical', false], ['lambert', false], ['phong', false], ['standard', true]],
                [['standard', false], ['physical', false], ['lambert', false], ['phong', false], ['standard', true], ['lambert', true]]);

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
        const colors = await opened.page.evaluate(([bytes, all, from, to, counts]) => {
            const {page} = window as unknown as Window;
            return page.grid(page.open(bytes), all, from, to, counts);
        }, [lit.base64, cells, low, high, resolution] as const);
        const wanted = cells.map(({center, normal}) => lit.radiance({position: center, normal}));
        const largest = Math.max(...wanted.flat());
        colors.forEach((color, i) => {
            color.forEach((value, k) => expect(Math.abs(value - wanted[i][k]), `cell ${i}`).toBeLessThan(2e-3 * largest));
        });
    });

    test('the helper shows the light of probes and the edges of cells', async () => {
        const probes = [0, 5, lit.volume.probeCount - 1];
        const normal = [0.48, 0.6, 0.64];
        const shown = await opened.page.evaluate(([bytes, all, view]) => {
            const {page} = window as unknown as Window;
            return page.helper(page.open(bytes), all, view, {sky: 0.25});
        }, [lit.base64, probes, normal] as const);
        const wanted = () => probes.map(i => irradiance(lit.volume.irradiance, normal, kCoefficients * i));
        // Balls interpolate light between their corners.
        const compare = (colors: number[][], want: number[][]) => colors.flat().forEach((value, i) => {
            expect(Math.abs(value - Math.max(0, want.flat()[i]) / Math.PI)).toBeLessThan(0.01 * Math.max(...want.flat()));
        });
        compare(shown.full, wanted());
        lit.volume.setWeights({sky: 0.25});
        compare(shown.dimmed, wanted());
        lit.volume.setWeights({sky: 1});
        // In space, cells of which all are tetrahedra: Euler's formula for balls, V - E + F - C = 1.
        const {cells, info: {innerCellCount}} = lit.volume.data;
        const outerFaces = cells.length / 8 - innerCellCount;
        const faces = (4 * innerCellCount + outerFaces) / 2;
        expect(shown.edges).toBe(lit.volume.probeCount + faces - innerCellCount - 1);
        expect(shown.lines).toBe(shown.edges);
        expect(shown.after).toEqual(shown.before);
    });
});
