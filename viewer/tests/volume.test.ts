// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {kCoefficients} from '../src/sh';
import {blend, cornersOf, edgesOf, kNone, readHealth, readInfo, readLayers, sumAmbient, sumLayers,
        Volume} from '../src/volume';

/** One tetrahedron and its four hull cells. */
const kCells = new Uint32Array([
    0, 1, 2, 3, 1, 2, 3, 4,
    1, 2, 3, kNone, 0, 0, 0, 0, 0, 2, 3, kNone, 0, 0, 0, 0,
    0, 1, 3, kNone, 0, 0, 0, 0, 0, 1, 2, kNone, 0, 0, 0, 0,
]);

function volumeOf(layers: number[][] = []): Volume {
    const light = (value: number) => new Float32Array(4 * kCoefficients).map((_, i) => value + Math.floor(i / kCoefficients));
    return {
        cells: kCells, innerCellCount: 1, probeCount: 4, irradiance: light(10),
        ambient: new Float32Array(kCoefficients).fill(7),
        layers: layers.map(([weight, value], i) => ({name: `layer ${i}`, weight, irradiance: light(value)})),
        layerAmbients: layers.map(([, value]) => new Float32Array(kCoefficients).fill(value)),
    } as unknown as Volume;
}

test('each edge of a tetrahedron is listed once, as one of the hull', () => {
    const {inner, hull} = edgesOf(kCells, 1);
    expect(inner).toHaveLength(0);
    expect([...hull]).toEqual([0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3]);
});

test('an edge between inner cells alone is no edge of the hull', () => {
    // Two tetrahedra and one hull cell, which does not have the edge 0-1.
    const cells = new Uint32Array([0, 1, 2, 3, 0, 0, 0, 0, 0, 1, 2, 4, 0, 0, 0, 0, 2, 3, 4, kNone, 0, 0, 0, 0]);
    const {inner, hull} = edgesOf(cells, 2);
    expect([...inner].slice(0, 2)).toEqual([0, 1]);
    expect(inner.length / 2 + hull.length / 2).toBe(10);  // nine of the tetrahedra, and 3-4
});

test('corners of hull cells are three', () => {
    expect(cornersOf(kCells, 0)).toEqual([0, 1, 2, 3]);
    expect(cornersOf(kCells, 1)).toEqual([1, 2, 3]);
    expect(cornersOf(kCells, kNone)).toEqual([]);
});

test('blended light is the weighted sum of corners and ambient light', () => {
    const volume = volumeOf();
    const places = {count: 2, cells: new Uint32Array([0, 1]), ambient: new Float32Array([0, 0.5]),
                    weights: new Float32Array([0.1, 0.2, 0.3, 0.4, 0.5, 0, 0, 0])};
    const sh = new Float32Array(2 * kCoefficients);
    for (const i of [0, 1]) blend(volume, volume, places, i, sh, i * kCoefficients);
    expect(sh[0]).toBeCloseTo(0.1 * 10 + 0.2 * 11 + 0.3 * 12 + 0.4 * 13, 4);
    expect(sh[kCoefficients]).toBeCloseTo(0.5 * 11 + 0.5 * 7, 4);
});

test('where there is no cell, light is ambient', () => {
    const volume = volumeOf();
    const places = {count: 1, cells: new Uint32Array([kNone]), ambient: new Float32Array([1]),
                    weights: new Float32Array(4)};
    const sh = new Float32Array(kCoefficients);
    blend(volume, volume, places, 0, sh, 0);
    expect([...new Set(sh)]).toEqual([7]);
});

test('layers add up by their weights', () => {
    const volume = volumeOf([[1, 100], [1, 1000]]);
    const sum = sumLayers(volume, [2, 0.5]);
    expect(sum[0]).toBe(2 * 100 + 0.5 * 1000);
    expect(sum[3 * kCoefficients]).toBe(2 * 103 + 0.5 * 1003);
    expect(sumAmbient(volume, [2, 0.5])[5]).toBe(2 * 100 + 0.5 * 1000);
});

test('without layers the light is the volume’s own', () => {
    const volume = volumeOf();
    expect(sumLayers(volume, [])).toBe(volume.irradiance);
    expect(sumAmbient(volume, [])).toBe(volume.ambient);
});

test('sections are read as docs/file_format.md lays them out', () => {
    const info = new DataView(new ArrayBuffer(208));
    [1, 2, 3].forEach((x, i) => info.setFloat64(8 * i, x, true));
    info.setUint32(80, 4, true);
    info.setUint32(84, 99, true);
    info.setFloat32(92 + 26 * 4, 5, true);
    const read = readInfo(info.buffer);
    expect([read.origin, read.dimension, read.innerCellCount, read.ambient[26]]).toEqual([[1, 2, 3], 4, 99, 5]);

    const health = new DataView(new ArrayBuffer(24));
    [0.5, 2, 3, 0, 4].forEach((x, i) => health.setFloat32(4 * i, x, true));
    health.setUint32(20, 1, true);
    expect(readHealth(health.buffer)).toEqual([{error: 0.5, surface: 2, offset: 5, isDilated: true}]);

    const layers = new DataView(new ArrayBuffer(2 * 128));
    layers.setFloat32(128, 0.25, true);
    layers.setFloat32(128 + 8 + 4, 6, true);
    const irradiance = new Float32Array([1, 2, 3, 4]);
    const {layers: [, sky], ambients} = readLayers(layers.buffer, ['sun', 'sky'], irradiance);
    expect([sky.name, sky.weight, [...sky.irradiance], ambients[1][1]]).toEqual(['sky', 0.25, [3, 4], 6]);
});
