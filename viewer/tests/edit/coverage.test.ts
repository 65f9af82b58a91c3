// SPDX-License-Identifier: Apache-2.0
import type {Volume} from 'tetralight';
import {expect, test} from 'vitest';

import {makeBox} from '../../src/edit/box_kinds';
import type {Box} from '../../src/edit/boxes';
import {findCoverage, findPlaces, isForbidden, nearestTo, SceneSpace, shareOf, Slices} from '../../src/edit/coverage';
import type {Position} from '../../src/edit/groups';
import {TriangleTree} from '../../src/edit/triangle_tree';

const kSlices = () => new Slices(() => true);

/** Two triangles; they face along the cross product of the sides. */
function quad(corner: Position, u: Position, v: Position): number[] {
    const at = (a: number, b: number) => corner.map((x, i) => x + a * u[i] + b * v[i]);
    return [at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)].flat();
}

/** A room from 0 to 4 by 2 by 2 whose faces look inwards; with a wall at x = 2 on both sides. */
function room(hasWall: boolean, lamps: Position[] = [[1, 1, 1]]): SceneSpace {
    const faces = [
        quad([0, 0, 0], [0, 0, 2], [4, 0, 0]), quad([0, 2, 0], [4, 0, 0], [0, 0, 2]),
        quad([0, 0, 0], [4, 0, 0], [0, 2, 0]), quad([0, 0, 2], [0, 2, 0], [4, 0, 0]),
        quad([0, 0, 0], [0, 2, 0], [0, 0, 2]), quad([4, 0, 0], [0, 0, 2], [0, 2, 0]),
    ];
    if (hasWall) faces.push(quad([2, 0, 0], [0, 2, 0], [0, 0, 2]));
    const corners = Float32Array.from(faces.flat());
    return {tree: new TriangleTree(corners, new Uint8Array(corners.length / 9).fill(hasWall ? 1 : 0)),
            low: [0, 0, 0], high: [4, 2, 2], lamps};
}

/** One cell up to x = `end`, with one probe that has all weight. */
const oneProbe = (at: Position, end: number) => ({
    probeCount: 1, position: () => at, data: {info: {innerCellCount: 1}},
    locate: ([x]: number[]) => ({cell: x < end ? 0 : 1, probes: [0], weights: [1]}),
}) as unknown as Volume;

test('places are in free space, the same each time, and a closed room is a space of its own', async () => {
    const space = {...room(false), low: [-4, 0, 0] as Position};
    const places = (await findPlaces(space, kSlices()))!;
    const isInRoom = places.positions.map(([x]) => x > 0);
    const spacesOf = (isIn: boolean) => new Set(places.spaces.filter((_, i) => isInRoom[i] === isIn));
    const [inner] = spacesOf(true);
    expect(spacesOf(true).size).toBe(1);
    expect(spacesOf(false).has(inner)).toBe(false);
    expect(places.isLit[inner]).toBe(true);
    expect((await findPlaces(space, kSlices()))!.positions).toEqual(places.positions);
});

test('all of an open room is covered, up to where the tetrahedra end', async () => {
    const space = room(false);
    const places = (await findPlaces(space, kSlices()))!;
    const all = await findCoverage(space, places, oneProbe([1, 1, 1], 9), [], kSlices());
    expect(shareOf(all!)).toBe(1);
    const part = (await findCoverage(space, places, oneProbe([1, 1, 1], 3), [], kSlices()))!;
    expect(part.outside.every(([x]) => x >= 3)).toBe(true);
    expect(shareOf(part)).toBeCloseTo(3 / 4, 1);
});

test('a wall hides the probe from the room behind it, if that room has light', async () => {
    const probes = oneProbe([1, 1, 1], 9);
    const cover = async (space: SceneSpace) => {
        const places = (await findPlaces(space, kSlices()))!;
        return (await findCoverage(space, places, probes, [], kSlices()))!;
    };
    const lit = await cover(room(true, [[1, 1, 1], [3, 1, 1]]));
    expect(lit.unseen.every(([x]) => x > 2)).toBe(true);
    expect(shareOf(lit)).toBeCloseTo(1 / 2, 1);
    expect(shareOf(await cover(room(true)))).toBe(1);  // a dark hollow does not count
});

test('without probes nothing is covered; places where probes are forbidden do not count', async () => {
    const space = room(false);
    const places = (await findPlaces(space, kSlices()))!;
    expect(shareOf((await findCoverage(space, places, null, [], kSlices()))!)).toBe(0);
    const end: Box = {...makeBox('adjustments', 'end', [3.5, 1, 1]), size: [1.001, 2, 2]};
    const cover = (await findCoverage(space, places, oneProbe([1, 1, 1], 3), [end], kSlices()))!;
    expect(shareOf(cover)).toBe(1);
    const allowed: Box = {...end, name: 'allowed', size: [0.5, 1, 1], settings: {forbid: false}};
    expect(isForbidden([end, allowed], [3.5, 1, 1])).toBe(false);
    expect(isForbidden([end, allowed], [3.9, 1, 1])).toBe(true);
});

test('work that nobody wants any more ends', async () => {
    const slices = new Slices(() => false);
    expect(await findPlaces({...room(false), low: [0, 0, 0]}, slices).then(async places => {
        while (await slices.next()) await new Promise(done => setTimeout(done));
        return places === null || places.positions.length > 0;
    })).toBe(true);
});

test('the nearest are found', () => {
    const line: Position[] = [[5, 0, 0], [1, 0, 0], [3, 0, 0], [2, 0, 0]];
    expect(nearestTo([0, 0, 0], line, 2)).toEqual([1, 3]);
});
