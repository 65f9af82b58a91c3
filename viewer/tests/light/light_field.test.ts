// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {gridOf, pointsOf} from '../../src/light/light_field';
import {kLeastSize, LppvBox} from '../../src/inspect/lppv_box';
import {pickBall} from '../../src/light/probe_balls';

test('the points of a grid go from face to face of its box', () => {
    const box = new three.Box3(new three.Vector3(-4, 0, 10), new three.Vector3(4, 2, 12));
    const grid = gridOf(box);
    const points = pointsOf(grid);
    expect(points).toHaveLength(3 * grid.resolution.reduce((product, n) => product * n, 1));
    expect(new three.Box3().setFromArray(points)).toEqual(box);
    expect([...points.slice(0, 6)]).toEqual([-4, 0, 10, expect.closeTo(-4 + 8 / (grid.resolution[0] - 1), 4), 0, 10]);
});

test('flat and endless boxes have grids of bounded size', () => {
    for (const size of [[10, 0, 10], [1e4, 1, 1], [0, 0, 0]]) {
        const {resolution} = gridOf(new three.Box3(new three.Vector3(), new three.Vector3(...size)));
        for (const count of resolution) expect(count).toBeGreaterThanOrEqual(2);
        expect(resolution.reduce((product, n) => product * n, 1)).toBeLessThanOrEqual(20000);
    }
});

test('the grid of a proxy volume has its faces, and two points or more along each edge', () => {
    const box = new LppvBox();
    box.group.position.set(1, 2, 3);
    box.group.scale.set(6, kLeastSize, 100);
    const {low, size, resolution} = box.grid;
    expect(low.toArray()).toEqual([-2, 2 - kLeastSize / 2, -47]);
    expect(size.toArray()).toEqual([6, kLeastSize, 100]);
    expect(resolution).toEqual([13, 2, 32]);
});

test('a ray picks the nearest ball in front of it', () => {
    const positions = [0, 0, 5, 0, 0, 9, 0, 0, -3, 4, 0, 5];
    const ray = new three.Ray(new three.Vector3(0, 0.1, 0), new three.Vector3(0, 0, 1));
    expect(pickBall(positions, 0.5, ray)).toBe(0);
    expect(pickBall(positions, 0.05, ray)).toBe(-1);
    expect(pickBall(positions, 0.5, ray, 0.01)).toBe(-1);  // drawn with a radius of 0.05 at a distance of 5
});
