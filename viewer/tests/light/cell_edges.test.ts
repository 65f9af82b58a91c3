// SPDX-License-Identifier: Apache-2.0
import {kNone} from 'tetralight';
import {expect, test} from 'vitest';

import {edgesOf} from '../../src/light/cell_edges';

/** One tetrahedron and its four hull cells. */
const kCells = new Uint32Array([
    0, 1, 2, 3, 1, 2, 3, 4,
    1, 2, 3, kNone, 0, 0, 0, 0, 0, 2, 3, kNone, 0, 0, 0, 0,
    0, 1, 3, kNone, 0, 0, 0, 0, 0, 1, 2, kNone, 0, 0, 0, 0,
]);

test('each edge of a tetrahedron is listed once, as one of the hull', () => {
    const {inner, hull} = edgesOf(kCells, 1);
    expect(inner).toHaveLength(0);
    expect([...hull]).toEqual([0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3]);
});

test('an edge between inner cells alone is not an edge of the hull', () => {
    // Two tetrahedra and one hull cell, which does not have the edge 0-1.
    const cells = new Uint32Array([0, 1, 2, 3, 0, 0, 0, 0, 0, 1, 2, 4, 0, 0, 0, 0, 2, 3, 4, kNone, 0, 0, 0, 0]);
    const {inner, hull} = edgesOf(cells, 2);
    expect([...inner].slice(0, 2)).toEqual([0, 1]);
    expect(inner.length / 2 + hull.length / 2).toBe(10);  // nine of the tetrahedra, and 3-4
});
