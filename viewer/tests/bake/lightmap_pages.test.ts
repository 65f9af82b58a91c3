// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {pagePixels} from '../../src/bake/lightmap_pages';

const half = three.DataUtils.toHalfFloat;

test('a page of the same light everywhere is middle grey, compressed, and texels without light are clear', () => {
    const texels = [[2, 2, 2, 1], [2, 2, 2, 1], [2, 2, 2, 1], [7, 7, 7, 0]];
    const irradiance = Uint16Array.from(texels.flat(), half);
    const pixels = pagePixels({pageSize: 2, scale: 3, irradiance}, 0);
    const grey = 0.18 / 1.18;
    const expected = Math.round(255 * (1.055 * grey ** (1 / 2.4) - 0.055));
    // The first row of texels is at v = 0, the last of the picture.
    expect([...pixels.subarray(8)]).toEqual([expected, expected, expected, 255, expected, expected, expected, 255]);
    expect([...pixels.subarray(0, 4)]).toEqual([expected, expected, expected, 255]);
    expect([...pixels.subarray(4, 8)]).toEqual([0, 0, 0, 0]);
});

test('each page has pixels of its own', () => {
    const irradiance = Uint16Array.from([1, 0, 0, 1, 0, 0, 1, 1], half);
    const [first, second] = [0, 1].map(page => [...pagePixels({pageSize: 1, scale: 1, irradiance}, page)]);
    expect(first[0]).toBeGreaterThan(first[2]);
    expect(second[2]).toBeGreaterThan(second[0]);
});
