// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import type {OpenVolume} from '../../src/light/volume';
import {VolumeMarks} from '../../src/light/volume_marks';

/** One tetrahedron with edges of 1 and √2. */
const kVolume = {
    positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]), health: [],
    probes: {data: {cells: new Uint32Array([0, 1, 2, 3, 0, 0, 0, 0]), validity: new Float32Array([1, 1, 1, 0]),
                    info: {innerCellCount: 1}}},
} as unknown as OpenVolume;

const kAll = {probes: true, cells: true, ring: true, others: true};
const tintOf = (marks: VolumeMarks, probe: number) =>
    [...(marks.balls!.mesh.geometry.getAttribute('tint').array as Float32Array).subarray(4 * probe, 4 * probe + 4)];

test('balls are small beside the distance between probes', () => {
    const marks = new VolumeMarks();
    marks.show(kVolume);
    expect(marks.balls!.radius).toBeCloseTo(0.07, 6);
});

test('the ring is around the selected probe, and another volume has none', () => {
    const marks = new VolumeMarks();
    marks.show(kVolume);
    marks.showParts(kAll);
    expect(marks.ring.visible).toBe(false);
    marks.select(1);
    marks.showParts(kAll);
    expect(marks.ring.visible).toBe(true);
    expect(marks.ring.position.distanceTo(new three.Vector3(1, 0, 0))).toBe(0);
    marks.show(kVolume);
    marks.showParts(kAll);
    expect(marks.ring.visible).toBe(false);
});

test('a probe shows its light, or what it is worth', () => {
    const marks = new VolumeMarks();
    marks.show(kVolume);
    expect(tintOf(marks, 0)[3]).toBe(0);
    marks.color = 'validity';
    expect(tintOf(marks, 0)).not.toEqual(tintOf(marks, 3));
    expect(tintOf(marks, 0)[3]).toBe(1);
});

test('edges of cells are made when they are shown', () => {
    const marks = new VolumeMarks();
    marks.show(kVolume);
    const edgeCount = () => (marks.lines.group.children as three.LineSegments[]).reduce(
        (sum, {geometry}) => sum + (geometry.index?.count ?? 0) / 2, 0);
    marks.showParts({...kAll, cells: false});
    expect(edgeCount()).toBe(0);
    marks.showParts(kAll);
    expect(edgeCount()).toBe(6);
});
