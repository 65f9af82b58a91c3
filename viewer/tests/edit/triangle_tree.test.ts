// SPDX-License-Identifier: Apache-2.0
import {Ray, Vector3} from 'three';
import {expect, test} from 'vitest';

import {TriangleTree} from '../../src/edit/triangle_tree';
import {random} from '../random';

test('rays meet what a search through all triangles finds', () => {
    const next = random(7);
    const corners = Float32Array.from({length: 9 * 300}, (_, i) => i % 9 < 3 ? 10 * next() : 0);
    for (let i = 0; i < corners.length; ++i) {
        if (i % 9 >= 3) corners[i] = corners[i - i % 9 + i % 3] + 2 * next() - 1;
    }
    const tree = new TriangleTree(corners);
    const at = (i: number) => new Vector3().fromArray(corners, i);
    let hits = 0;
    for (let n = 0; n < 200; ++n) {
        const origin = new Vector3(10 * next(), 10 * next(), 10 * next());
        const direction = new Vector3(next() - 0.5, next() - 0.5, next() - 0.5).normalize();
        const ray = new Ray(origin, direction);
        let nearest = Infinity;
        for (let i = 0; i < corners.length; i += 9) {
            const hit = ray.intersectTriangle(at(i), at(i + 3), at(i + 6), false, new Vector3());
            if (hit !== null) nearest = Math.min(nearest, hit.distanceTo(origin));
        }
        const found = tree.nearest(origin.toArray(), direction.toArray());
        if (nearest < Infinity) ++hits;
        if (nearest === Infinity) expect(found).toBeNull();
        else expect(found!.distance).toBeCloseTo(nearest, 4);
    }
    expect(hits).toBeGreaterThan(20);
});

test('back faces are those whose corners are clockwise, and two-sided triangles have none', () => {
    const corners = Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0]);  // faces +z
    const hitFrom = (tree: TriangleTree, z: number) => tree.nearest([0.2, 0.2, z], [0, 0, -Math.sign(z)])!.isBack;
    const tree = new TriangleTree(corners);
    expect([hitFrom(tree, 1), hitFrom(tree, -1)]).toEqual([false, true]);
    expect(hitFrom(new TriangleTree(corners, [1]), -1)).toBe(false);
    expect(tree.isFree([0.2, 0.2, 1], [0.2, 0.2, -1])).toBe(false);
    expect(tree.isFree([0.9, 0.9, 1], [0.9, 0.9, -1])).toBe(true);
    expect(new TriangleTree(new Float32Array()).nearest([0, 0, 0], [0, 0, 1])).toBeNull();
});
