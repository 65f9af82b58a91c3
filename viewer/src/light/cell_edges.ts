// SPDX-License-Identifier: Apache-2.0
import {kNone} from 'tetralight';

export interface Edges {
    inner: Uint32Array;  // two probes an edge
    hull: Uint32Array;
}

/** Every edge once; those of the hull apart. Cells are as in `VolumeData`. */
export function edgesOf(cells: Uint32Array, innerCellCount: number): Edges {
    const cellCount = cells.length / 8;
    const hull = uniqueEdges(cells, innerCellCount, cellCount);
    const inner = uniqueEdges(cells, 0, innerCellCount);
    const onHull = new Set(hull);
    return {inner: pairs(inner.filter(key => !onHull.has(key))), hull: pairs(hull)};
}

const kKey = 2 ** 26;

function uniqueEdges(cells: Uint32Array, begin: number, end: number): Float64Array {
    const keys = new Float64Array((end - begin) * 6);
    let count = 0;
    for (let cell = begin; cell < end; ++cell) {
        for (let a = 0; a < 3; ++a) {
            for (let b = a + 1; b < 4; ++b) {
                const i = cells[8 * cell + a];
                const j = cells[8 * cell + b];
                if (i === kNone || j === kNone) continue;
                keys[count++] = Math.min(i, j) * kKey + Math.max(i, j);
            }
        }
    }
    return keys.subarray(0, count).sort().filter((key, i, all) => i === 0 || key !== all[i - 1]);
}

function pairs(keys: Float64Array): Uint32Array {
    const ends = new Uint32Array(keys.length * 2);
    keys.forEach((key, i) => {
        ends[2 * i] = Math.floor(key / kKey);
        ends[2 * i + 1] = key % kKey;
    });
    return ends;
}
