// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {parseReflections, probesNear, reflectionOrder} from '../src/reflections';
import {samplePacked} from '../src/sh';
import {probeAt, reflectionFile} from './reflection_file';

const hall = probeAt([1, 2, 3], [-4, 0, 0], [4, 3, 6], {blend_distance: 0.5, importance: 2});
const sky = {...probeAt([0, 0, 0], [0, 0, 0], [0, 0, 0]), box: null};
/** Two probes, and the cubes of a layer of each. */
const file = () => reflectionFile([hall, sky], [4, 2], 4, (cube, face, level) => [cube, face, level]);

test('boxes, blend distances and importances of probes are read', () => {
    const {size, levelCount, probes} = parseReflections(file());
    expect([size, levelCount, probes.length]).toEqual([4, 2, 2]);
    expect(probes[0].position.toArray()).toEqual([1, 2, 3]);
    expect(probes[0].box!.halfSize.toArray()).toEqual([4, 1.5, 3]);
    expect(probes[0].box!.center.toArray()).toEqual([-1, -0.5, 0]);
    expect([probes[0].blendDistance, probes[0].importance]).toEqual([0.5, 2]);
    expect(probes[1].box).toBeNull();
});

test('each face of each level has its own texels, and layers are left out', () => {
    const {faces, probes} = parseReflections(file());
    const first = (texels: Uint16Array) => [...texels.slice(0, 4)].map(three.DataUtils.fromHalfFloat);
    probes.forEach((_, cube) => [0, 1].forEach(level => {
        const found = faces(cube, level);
        expect(found.map(({length}) => length)).toEqual(Array(6).fill(4 * (4 >> level) ** 2));
        expect(found.map(first)).toEqual([0, 1, 2, 3, 4, 5].map(face => [cube, face, level, 1]));
    }));
});

test('the irradiance of probes is divided by pi', () => {
    // Under a sky of radiance 1, E = π for each normal: the first coefficient is π · √(4π).
    const irradiance_sh = [[1, 1, 1].map(x => x * Math.PI * Math.sqrt(4 * Math.PI)), ...hall.irradiance_sh.slice(1)];
    const {probes} = parseReflections(reflectionFile([{...hall, irradiance_sh}], [1], 1, () => [1, 1, 1]));
    for (const x of samplePacked(probes[0].irradiance, 0, [0, 1, 0])) expect(x).toBeCloseTo(1, 5);
});

test('other files and files that are cut off are refused', () => {
    expect(() => parseReflections(new ArrayBuffer(200))).toThrow('not a KTX 2.0 file');
    expect(() => parseReflections(file().slice(0, -1))).toThrow('ends within level');
    const flat = file();
    new DataView(flat).setUint32(36, 1, true);
    expect(() => parseReflections(flat)).toThrow('no reflection probes');
    const floats = file();
    new DataView(floats).setUint32(12, 109, true);
    expect(() => parseReflections(floats)).toThrow('format 109');
    expect(() => parseReflections(reflectionFile([hall, sky], [2], 1, () => [0, 0, 0]))).toThrow('1 of 2 probes');
});

const probesOf = (...setups: Parameters<typeof reflectionFile>[0]) =>
    parseReflections(reflectionFile(setups, [1], setups.length, () => [0, 0, 0])).probes;

test('important probes come first, then small boxes, then the order of the file', () => {
    const cube = (half: number, importance: number) =>
        probeAt([0, 0, 0], [-half, -half, -half], [half, half, half], {importance});
    expect(reflectionOrder(probesOf(sky, cube(2, 1), cube(1, 1), cube(3, 5), cube(1, 1)))).toEqual([3, 2, 4, 1, 0]);
});

test('a mesh sees the nearest probes and those that are everywhere', () => {
    const row = Array.from({length: 5}, (_, i) => probeAt([10 * i, 1, 0], [10 * i - 4, 0, -4], [10 * i + 4, 2, 4]));
    const probes = probesOf(sky, ...row);
    const mesh = new three.Box3(new three.Vector3(27, 0, 0), new three.Vector3(35.8, 1, 1));
    expect(probesNear(probes, mesh, 3)).toEqual([4, 5, 0]);  // 5 by its blend distance only
    expect(probesNear(probes, mesh, 4)).toEqual([3, 4, 5, 0]);
    expect(probesNear(probes, mesh, 9)).toEqual([1, 2, 3, 4, 5, 0]);
});

test('the box of a probe that is turned holds its corners', () => {
    const s = Math.SQRT1_2;
    const long = probeAt([0, 0, 0], [-10, -1, -1], [10, 1, 1]);
    const turned = {...long, box: {...long.box!, axes: [[s, 0, s], [0, 1, 0], [-s, 0, s]]}};
    const near = probeAt([0, 0, 0], [0, 0, 14], [1, 1, 15]);
    const corner = new three.Box3(new three.Vector3(7, 0, 7), new three.Vector3(7.1, 0.1, 7.1));
    expect(probesNear(probesOf(near, turned), corner, 1)).toEqual([1]);
});
