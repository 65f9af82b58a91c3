// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import * as groups from '../../src/edit/groups';

const kHall: groups.Groups = [
    {name: 'hall', positions: [[0, 0, 0], [1, 0, 0], [2, 0, 0]]},
    {name: 'attic', dering: true, rendering_layers: [0, 31], positions: [[0, 5, 0]]},
];

test('moving leaves the old value as it was, for undo', () => {
    const before = JSON.stringify(kHall);
    const moved = groups.move(kHall, [{group: 0, index: 1}, {group: 1, index: 0}], [0, 1, 0]);
    expect(moved[0].positions).toEqual([[0, 0, 0], [1, 1, 0], [2, 0, 0]]);
    expect(moved[1].positions).toEqual([[0, 6, 0]]);
    expect(JSON.stringify(kHall)).toBe(before);
});

test('duplicates are found where they are said to be', () => {
    const [copied, made] = groups.duplicate(kHall, [{group: 0, index: 2}, {group: 1, index: 0}], [0, 0, 1]);
    expect(made.map(({group, index}) => copied[group].positions[index])).toEqual([[2, 0, 1], [0, 5, 1]]);
    expect(groups.countOf(copied)).toBe(6);
});

test('removing takes exactly what was chosen', () => {
    const left = groups.remove(kHall, [{group: 0, index: 0}, {group: 0, index: 2}]);
    expect(left[0].positions).toEqual([[1, 0, 0]]);
    expect(groups.allRefs(left)).toEqual([{group: 0, index: 0}, {group: 1, index: 0}]);
});

test('new groups have names of their own', () => {
    const names = groups.addGroup(groups.addGroup(kHall, 'hall'), 'hall').map(group => group.name);
    expect(names).toEqual(['hall', 'attic', 'hall 2', 'hall 3']);
});

test('a group is renamed, to a name that no other has', () => {
    const names = (name: string) => groups.rename(kHall, 1, name).map(group => group.name);
    expect(names('loft')).toEqual(['hall', 'loft']);
    expect(names('attic')).toEqual(['hall', 'attic']);
    expect(names('hall')).toEqual(['hall', 'hall 2']);
});

test('files come back as they were; groups without probes are left out', () => {
    expect(groups.parseGroups(groups.formatGroups(groups.addGroup(kHall, 'empty')))).toEqual(kHall);
});

test('transforms of files are applied, column-major', () => {
    // A quarter turn about +Y, then 10 along X: (x, y, z) to (z + 10, y, -x).
    const transform = [0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 10, 0, 0, 1];
    const [group] = groups.parseGroups(JSON.stringify({groups: [{name: 'a', transform, positions: [[1, 2, 3]]}]}));
    expect(group.positions).toEqual([[13, 2, -1]]);
});

test('groups of a volume have its exact positions; probes that were left out are missing', () => {
    const volume = {
        groupNames: ['a', 'b'], exactPositions: new Float64Array([0.1, 0.2, 0.3, 1, 2, 3]),
        sources: new Uint32Array([0, 0, 1, 1, 0, 0xffffffff, 1, 1, 0]), renderingLayers: new Uint32Array(),
    };
    expect(groups.groupsOfVolume(volume as never)).toEqual([
        {name: 'a', positions: [[1, 2, 3]]}, {name: 'b', positions: [[0.1, 0.2, 0.3]]},
    ]);
});

test('groups of a volume are on the rendering layers of most of their probes', () => {
    const volume = {
        groupNames: ['a', 'b'], exactPositions: new Float64Array(12),
        // Probe 2 is welded: it is on the layers of both groups.
        sources: new Uint32Array([0, 0, 0, 0, 1, 1, 0, 2, 2, 1, 0, 2, 1, 1, 3, 1, 2, 3]),
        renderingLayers: new Uint32Array([0x80000001, 0x80000001, 0xffffffff, 0xffffffff]),
    };
    expect(groups.groupsOfVolume(volume as never).map(group => group.rendering_layers)).toEqual([[0, 31], undefined]);
});
