// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {makeBox} from '../../src/edit/box_kinds';
import {areSame, Box, middleOf} from '../../src/edit/boxes';
import {readGlbJson, withGlbJson} from '../../src/scene/glb';
import {boxesOf, withBoxes} from '../../src/edit/scene_boxes';
import type {Gltf} from '../../src/scene/glb';

const kTurn = [0, Math.SQRT1_2, 0, Math.SQRT1_2];  // a quarter about Y: x to −z
const kScene: Gltf = {
    scenes: [{nodes: [0, 2]}],
    nodes: [
        {name: 'house', mesh: 0, translation: [10, 0, 0], rotation: kTurn, scale: [2, 2, 2], children: [1]},
        {name: 'hall', translation: [1, 0, 0], extras: {reflection_probe: {size: [4, 3, 6], center: [0, 0.5, 0], importance: 2}}},
        {name: 'lamp', mesh: 1, extras: {probe_adjustment: {shape: 'sphere', radius: 2, intensity: 0.5}, material: 'brass'}},
        {name: 'hidden', extras: {portal: [1, 1]}},
    ],
};

test('boxes are where their nodes put them, with the scale', () => {
    const [hall, lamp, ...others] = boxesOf(kScene);
    expect(others).toEqual([]);  // nodes outside of the scene are not read
    expect(hall).toMatchObject({kind: 'reflections', name: 'hall', position: [10, 0, -2], size: [8, 6, 12], offset: [0, 1, 0],
                                rotation: [0, 90, 0], settings: {importance: 2}});
    expect(middleOf(hall)).toEqual([10, 1, -2]);
    expect(lamp).toMatchObject({kind: 'adjustments', shape: 'sphere', size: [4, 4, 4], settings: {intensity: 0.5}});
});

test('a scene holds exactly the boxes that are written to it', () => {
    const [hall, lamp] = boxesOf(kScene);
    const window: Box = {...makeBox('portals', 'window', [1, 2, 3]), rotation: [0, 45, 0]};
    const squashed: Box = {...lamp, name: 'squashed', size: [4, 1, 4], position: [0, 1, 0]};
    for (const boxes of [[], [hall], [window, hall, lamp], [{...hall, size: [1, 2, 3]} as Box, lamp], [squashed, {...lamp, position: [0, 9, 0]} as Box]]) {
        const made = boxesOf(withBoxes(kScene, boxes));
        expect(areSame(made, [...boxes].reverse())).toBe(true);
        const byName = (list: readonly Box[]) => [...list].sort((a, b) => a.name < b.name ? -1 : 1);
        expect(byName(made)).toEqual(byName(boxes));
    }
});

test('nodes of unchanged boxes stay, and those of others keep their other purposes', () => {
    const [hall, lamp] = boxesOf(kScene);
    expect(withBoxes(kScene, [lamp, hall])).toEqual(kScene);
    const without = withBoxes(kScene, []);
    expect(without.nodes![2]).toEqual({name: 'lamp', mesh: 1, extras: {material: 'brass'}});
    expect(without.nodes![0].children).toBeUndefined();
    expect(without.scenes![0].nodes).toEqual([0, 2]);
    const moved = withBoxes(kScene, [lamp, {...hall, position: [0, 0, 0]}]);
    expect(moved.nodes!.length).toBe(kScene.nodes!.length);  // the node is used again
    expect(moved.scenes![0].nodes).toEqual([0, 2, 1]);
    expect(JSON.stringify(kScene)).toContain('reflection_probe');  // and the old value stays
});

test('a binary file keeps all bytes but its JSON', () => {
    const binary = Uint8Array.from([8, 0, 0, 0, 0x42, 0x49, 0x4e, 0, 1, 2, 3, 4, 5, 6, 7, 8]);
    const empty = new Uint8Array(20 + 4 + binary.length);
    new Uint32Array(empty.buffer, 0, 5).set([0x46546c67, 2, empty.length, 4, 0x4e4f534a]);
    empty.set([0x7b, 0x7d, 0x20, 0x20], 20);
    empty.set(binary, 24);
    const made = withGlbJson(empty.buffer, kScene);
    expect(readGlbJson(made)).toEqual(kScene);
    expect(made.byteLength % 4).toBe(0);
    expect(new DataView(made).getUint32(8, true)).toBe(made.byteLength);
    expect(new Uint8Array(made).slice(-binary.length)).toEqual(binary);
    expect(() => readGlbJson(new ArrayBuffer(64))).toThrow(/not a binary glTF/);
});
