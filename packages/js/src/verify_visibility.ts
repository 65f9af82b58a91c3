// SPDX-License-Identifier: Apache-2.0
import {kElementSize, kUnknownEdge} from './edge_visibility.js';
import {elementError, sectionError} from './error.js';
import {vertexCount, VolumeData} from './volume_data.js';

/** Blocks name the elements of their cells without gaps, and elements have codes of edges that their cells have. */
export function checkVisibility(v: VolumeData): void {
    const {visibilityBlocks: blocks, cellVisibility} = v;
    if (blocks.length === 0 && cellVisibility.length === 0) return;
    const cells = v.cells.length / 8;
    const count = Math.ceil(cells / 32);
    if (blocks.length / 2 !== count) {
        throw sectionError('visibility_blocks', `${blocks.length / 2} elements instead of ${count}`);
    }
    const elements = cellVisibility.length / kElementSize;
    let element = 0;
    for (let block = 0; block < count; ++block) {
        if (blocks[2 * block] !== element) {
            throw elementError('visibility_blocks', block, `begins at ${blocks[2 * block]} instead of ${element}`);
        }
        for (let bit = 0; bit < 32; ++bit) {
            if ((blocks[2 * block + 1] >>> bit & 1) === 0) continue;
            const cell = 32 * block + bit;
            if (cell >= cells) throw elementError('visibility_blocks', block, 'marks a cell that does not exist');
            if (element >= elements) throw sectionError('cell_visibility', `${elements} elements are too few`);
            const problem = elementProblem(cellVisibility, element * kElementSize, vertexCount(v, cell));
            if (problem !== '') throw elementError('cell_visibility', element, problem);
            ++element;
        }
    }
    if (element !== elements) throw sectionError('cell_visibility', `${elements} elements instead of ${element}`);
}

/** What is wrong with the element of a cell with so many vertices; empty if nothing is. */
function elementProblem(bytes: Uint8Array, at: number, vertices: number): string {
    let isStored = false;
    let possible = 0;
    for (let from = 0; from < 4; ++from) {
        const isBlocked = [false, false, false];
        for (let k = 0; k < 3; ++k) {
            const code = bytes[at + 4 * k + from];
            const isEdge = from < vertices && (from + k + 1) % 4 < vertices;
            if (!isEdge && code !== 0) return 'has a code for an edge that does not exist';
            isStored ||= code >= kUnknownEdge;
            isBlocked[k] = code > kUnknownEdge;
        }
        if (isBlocked[0] && isBlocked[1]) possible |= 1 << from;
        if (isBlocked[0] && isBlocked[2]) possible |= 1 << 4 + from;
        if (isBlocked[1] && isBlocked[2]) possible |= 1 << 8 + from;
    }
    if (!isStored) return 'has free edges only';
    const splits = bytes[at + 12] | bytes[at + 13] << 8;
    return (splits & ~possible) === 0 ? '' : 'splits edges that are not blocked';
}
