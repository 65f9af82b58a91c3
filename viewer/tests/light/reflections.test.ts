// SPDX-License-Identifier: Apache-2.0
import {readReflections} from 'tetralight';
import * as three from 'three';
import {expect, test} from 'vitest';

import {probesNear, reflectionOrder, reflectionWeights} from '../../src/light/reflections';
import {probeAt, reflectionFile} from '../reflection_file';

const sky = {...probeAt([0, 0, 0], [0, 0, 0], [0, 0, 0]), box: null};

const probesOf = (...setups: Parameters<typeof reflectionFile>[0]) =>
    readReflections(reflectionFile(setups, [1], setups.length, () => [0, 0, 0])).probes;

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

test('probes share a place by their influence, and those everywhere take the rest', () => {
    const left = probeAt([-5, 1, 0], [-10, 0, -5], [0, 2, 5], {blend_distance: 1});
    const probes = probesOf(left, sky);
    expect(reflectionWeights(probes, [-5, 1, 0])).toEqual([{probe: 0, weight: 1}]);
    const half = reflectionWeights(probes, [0.5 + 0.005, 1, 0]);  // halfway out, with the reach of the box
    expect(half.map(({probe}) => probe).sort()).toEqual([0, 1]);
    expect(half.reduce((sum, {weight}) => sum + weight, 0)).toBeCloseTo(1, 6);
    for (const {weight} of half) expect(weight).toBeCloseTo(0.5, 1);
    expect(reflectionWeights(probes, [5, 1, 0])).toEqual([{probe: 1, weight: 1}]);
    expect(reflectionWeights(probesOf(left), [5, 1, 0])).toEqual([]);
});
