// SPDX-License-Identifier: Apache-2.0
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {kNone, lightmapIrradiance, Lightmaps, readLightmaps} from '../src/index.js';
import {Folder, kCommand, kCourtyard} from './command.js';
import {largestOf, makeRandom} from './random.js';
import {Entry, errorOf, sectionsOf, sign} from './sections.js';

const folder = new Folder();
afterAll(() => folder.remove());

describe.skipIf(kCommand === '' || kCourtyard === '')('lightmaps', () => {
    let bytes: Uint8Array;
    let lightmaps: Lightmaps;
    beforeAll(() => {
        folder.run('lightmap', kCourtyard, '-o', 'level.lightmaps', '--samples', '2', '--texels-per-meter', '0.4',
                   '--page-size', '128', '--layers', 'sun,sky', '--quiet');
        bytes = folder.bytes('level.lightmaps');
        lightmaps = readLightmaps(bytes);
    });

    test('have the numbers that `tetralight info` prints', () => {
        const info = JSON.parse(folder.run('info', 'level.lightmaps', '--json')) as Record<string, unknown>;
        const covered = lightmaps.irradiance.filter((half, i) => i % 4 === 3 && half > 0).length;
        expect(info).toMatchObject({
            pages: lightmaps.pageCount, page_size: 128, mixed_lighting: 'indirect',
            objects: lightmaps.rectangles.filter(({page}) => page !== kNone).length,
            texels: lightmaps.irradiance.length / 4, has_directions: lightmaps.light.length > 0,
            layers: lightmaps.layers.map(({name, weight}) => ({name, weight})),
        });
        expect(lightmaps.texelsPerMeter).toBeCloseTo(0.4, 6);
        expect(covered).toBeGreaterThan(100);
        expect(lightmaps.instanceNames).toHaveLength(lightmaps.rectangles.length);
    });

    test('have light where rectangles are', () => {
        const light = lightmapIrradiance(lightmaps);
        const placed = lightmaps.rectangles.filter(({page}) => page !== kNone);
        expect(placed.length).toBeGreaterThan(0);
        for (const {page, x, y, width, height} of placed) {
            let covered = 0;
            for (let row = y; row < y + height; ++row) {
                for (let column = x; column < x + width; ++column) {
                    if (light[4 * ((page * 128 + row) * 128 + column) + 3] > 0) ++covered;
                }
            }
            expect(covered).toBeGreaterThan(0);
        }
    });

    test('have the light of `tetralight relight` after their weights change', () => {
        folder.run('relight', 'level.lightmaps', '-o', 'relit.lightmaps', '--weights', 'sun=0.25,sky=2', '--quiet');
        const ours = lightmapIrradiance(lightmaps, {sun: 0.25, sky: 2});
        const theirs = lightmapIrradiance(readLightmaps(folder.bytes('relit.lightmaps')));
        const largest = largestOf(theirs.filter((_, i) => i % 4 < 3));
        expect(ours).toHaveLength(theirs.length);
        // Theirs are halves.
        theirs.forEach((value, i) => {
            if (Math.abs(ours[i] - value) > 2 ** -10 * value + 1e-5 * largest) expect(ours[i]).toBe(value);
        });
        expect(errorOf(() => lightmapIrradiance(lightmaps, {lamp: 1}))?.code).toBe('not_found');
    });

    test('are refused when they are cut off or any byte changes', () => {
        const random = makeRandom(30);
        for (let i = 0; i < 300; ++i) {
            const length = Math.floor(bytes.length * random());
            expect(errorOf(() => readLightmaps(bytes.slice(0, length)))?.code).toBe('corrupt');
            const changed = bytes.slice();
            const head = i % 2 === 0 ? 64 * (1 + sectionsOf(bytes).length) : bytes.length;
            const at = Math.floor(head * random());
            changed[at] ^= 1 << Math.floor(8 * random());
            expect(errorOf(() => readLightmaps(changed)), `byte ${at}`).toBeDefined();
        }
    });

    test('are refused with the section and the element that are wrong', () => {
        const change = (name: string, use: (view: DataView) => void) => {
            const changed = bytes.slice();
            const section = sectionsOf(changed).find(entry => entry.name === name) as Entry;
            use(new DataView(changed.buffer, section.offset, section.size));
            sign(changed, section);
            return errorOf(() => readLightmaps(changed));
        };
        const placed = lightmaps.rectangles.findIndex(({page}) => page !== kNone);
        const word = (offset: number, value: number) => (view: DataView) => view.setUint32(offset, value, true);
        expect(change('info', word(0, 20000))?.message).toBe('section "info": page size 20000 is not in 1 to 16384');
        expect(change('info', word(12, 0))?.message).toContain('scale 0');
        expect(change('info', word(24, 1))).toMatchObject({field: 'info[0]'});
        expect(change('rectangles', word(48 * placed + 16, 7))?.message).toContain('page 7 is out of range');
        expect(change('rectangles', word(48 * placed + 28, 1000))?.message).toContain('not inside a page');
        expect(change('irradiance', view => view.setUint16(8, 0x7c00, true))).toMatchObject({field: 'irradiance[1]'});
        expect(change('irradiance', view => view.setUint16(6, 0x3c01, true))?.message).toContain('half 3');
        expect(change('layers', word(16, 0xbf800000))).toMatchObject({field: 'layers[1]'});
        expect(change('corner_uvs', word(0, 0x40000000))).toMatchObject({field: 'corner_uvs[0]'});
    });

    test('whose rectangles overlap are refused', () => {
        const changed = bytes.slice();
        const [first, second] = lightmaps.rectangles.map((r, i) => ({r, i})).filter(({r}) => r.page !== kNone);
        const section = sectionsOf(changed).find(({name}) => name === 'rectangles') as Entry;
        const from = section.offset + 48 * first.i;
        changed.copyWithin(section.offset + 48 * second.i, from, from + 48);
        sign(changed, section);
        expect(errorOf(() => readLightmaps(changed))?.message).toContain(`element ${second.i}: overlaps rectangle ${first.i}`);
    });

    test('of another kind are refused', () => {
        const volume = folder.tetrahedralize([{name: 'a', positions: [[0, 0, 0]]}]);
        expect(errorOf(() => readLightmaps(volume))?.message).toBe('not a lightmap file (wrong first bytes)');
    });
});
