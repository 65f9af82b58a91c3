// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {isDense} from '../../src/scene/dense_mesh';

const plane = new three.PlaneGeometry(1, 1);  // its longest edge is its diagonal
const kDiagonal = Math.SQRT2;

test('the longest edge of a mesh decides', () => {
    expect(isDense(plane, new three.Matrix4(), kDiagonal * 1.001)).toBe(true);
    expect(isDense(plane, new three.Matrix4(), kDiagonal * 0.999)).toBe(false);
});

test('edges are measured in the world', () => {
    const large = new three.Matrix4().makeScale(3, 3, 3);
    expect(isDense(plane, large, kDiagonal * 2.99)).toBe(false);
    expect(isDense(plane, large, kDiagonal * 3.01)).toBe(true);
});

test('meshes without an index are measured, and those without normals are lit at their pixels', () => {
    expect(isDense(plane.toNonIndexed(), new three.Matrix4(), 1)).toBe(false);
    const bare = plane.clone();
    bare.deleteAttribute('normal');
    expect(isDense(bare, new three.Matrix4(), 10)).toBe(false);
});
