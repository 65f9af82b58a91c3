// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {kBoxKinds, makeBox} from '../../src/edit/box_kinds';
import * as boxes from '../../src/edit/boxes';
import type {Box} from '../../src/edit/boxes';

const kVolume: Box = {...makeBox('adjustments', 'volume', [1, 2, 3]), size: [4, 2, 6]};
const kBall: Box = {...kVolume, shape: 'sphere', size: [2, 2, 2]};

test('moving a side leaves the opposite one, and the old value', () => {
    const before = JSON.stringify(kVolume);
    const wide = boxes.moveSide(kVolume, {axis: 0, end: 1}, 1.1, 0.25);
    expect(wide.size).toEqual([5, 2, 6]);
    const low = (box: Box) => box.position[0] - box.size[0] / 2;
    expect(low(wide)).toBe(low(kVolume));
    const deep = boxes.moveSide(kVolume, {axis: 1, end: -1}, 1, 0);
    expect(deep.position[1] + deep.size[1] / 2).toBe(kVolume.position[1] + kVolume.size[1] / 2);
    expect(JSON.stringify(kVolume)).toBe(before);
});

test('a side of a rotated box moves along its own axis', () => {
    const turned = {...kVolume, rotation: [0, 90, 0]} as Box;  // its x is the −z of the world
    const grown = boxes.moveSide(turned, {axis: 0, end: 1}, 2, 0);
    expect(grown.size).toEqual([6, 2, 6]);
    grown.position.forEach((x, axis) => expect(x).toBeCloseTo([1, 2, 3 - 1][axis]));
});

test('a side never passes the opposite one', () => {
    expect(boxes.moveSide(kVolume, {axis: 0, end: 1}, -100, 0).size[0]).toBe(boxes.kLeastSide);
    expect(boxes.moveSide(kVolume, {axis: 0, end: 1}, -100, 0.25).size[0]).toBe(0.25);
});

test('a sphere grows around its middle', () => {
    const grown = boxes.moveSide(kBall, {axis: 2, end: -1}, 0.5, 0);
    expect(grown).toEqual({...kBall, size: [3, 3, 3]});
    expect(boxes.resize(kBall, [2, 5, 2]).size).toEqual([5, 5, 5]);
});

test('the place of a capture stays when the sides of its box move', () => {
    const hall = makeBox('reflections', 'hall', [1, 1.5, 2]);
    const grown = boxes.moveSide(hall, {axis: 0, end: 1}, 2, 0);
    expect(grown.position).toEqual(hall.position);
    expect(grown.offset).toEqual([1, 0, 0]);
    expect(boxes.middleOf(grown)).toEqual([2, 1.5, 2]);
});

test('degrees come back from rotations', () => {
    for (const rotation of [[0, 105, 0], [30, -170, 0], [-45, 15, 60], [0, 180, 0]] as const) {
        boxes.degreesOf(boxes.quaternionOf({rotation})).forEach((angle, i) => expect(angle).toBeCloseTo(rotation[i], 4));
    }
});

test('places in rotated boxes and in spheres are told from those outside', () => {
    const turned = {...kVolume, position: [0, 0, 0], size: [4, 1, 1], rotation: [0, 90, 0]} as Box;
    expect(boxes.contains(turned, [0, 0, 1.9])).toBe(true);
    expect(boxes.contains(turned, [1.9, 0, 0])).toBe(false);
    expect(boxes.contains({...kBall, position: [0, 0, 0]}, [0.9, 0, 0])).toBe(true);
    expect(boxes.contains({...kBall, position: [0, 0, 0]}, [0.9, 0.9, 0])).toBe(false);
});

test('names are free within their kind', () => {
    const all = [kVolume, {...kVolume, name: 'volume 2'}, makeBox('portals', 'window', [0, 0, 0])];
    expect(boxes.freeName(all, 'adjustments', 'volume 2')).toBe('volume 3');
    expect(boxes.freeName(all, 'portals', 'volume')).toBe('volume');
    expect(boxes.duplicate(all, 0).at(-1)).toMatchObject({name: 'volume 3', position: [5, 2, 3]});
});

test('a volume without a value is refused by name', () => {
    expect(kBoxKinds.adjustments.fault(kVolume)).toBe('');
    expect(kBoxKinds.adjustments.fault(boxes.withSetting(kVolume, 'forbid', undefined))).toMatch(/no effect/);
});

test('files of the command: what they cannot hold is refused', () => {
    const text = (box: Box) => JSON.parse(kBoxKinds.adjustments.file!.text([box])) as unknown;
    expect(text(kVolume)).toEqual({adjustments: [
        {name: 'volume', shape: 'box', center: [1, 2, 3], size: [4, 2, 6], forbid: true}]});
    expect(text(kBall)).toMatchObject({adjustments: [{shape: 'sphere', radius: 1}]});
    expect(() => text({...kVolume, rotation: [0, 15, 0]})).toThrow(/volume: the file of --adjustments holds no rotations/);
    const turned = {...makeBox('reflections', 'hall', [0, 1, 0]), rotation: [0, 90, 0], offset: [1, 0, 0]} as Box;
    const [{box}] = (JSON.parse(kBoxKinds.reflections.file!.text([turned])) as
        {reflection_probes: {box: {center: number[]; axes: number[][]}}[]}).reflection_probes;
    [0, 0, -1].forEach((x, i) => {  // its x is the −z of the world
        expect(box.center[i]).toBeCloseTo(x);
        expect(box.axes[0][i]).toBeCloseTo(x);
    });
});
