// SPDX-License-Identifier: Apache-2.0
import {elementError, sectionError} from './error.js';
import {kFinerGrid, kSeedGridHeader, kSeedGridLevels} from './seed_grid.js';

const kLongestSide = 1 << 20;

/** Grids follow each other without gaps; each but the first is named by voxels of grids before it. */
export function checkSeedGrid(words: Uint32Array, cellCount: number): void {
    if (words.length === 0) return;
    const levels = new Map([[0, 1]]);  // of the grids that are named and not checked yet, by place
    for (let place = 0; place < words.length;) {
        const level = levels.get(place);
        if (level === undefined) throw gridError(place, 'no voxel names it');
        levels.delete(place);
        const end = place + kSeedGridHeader + voxelCount(words, place);
        for (let word = place + kSeedGridHeader; word < end; ++word) checkWord(words, word, level, cellCount, levels);
        place = end;
    }
    for (const place of levels.keys()) throw sectionError('seed_grid', `there is no grid at ${place}`);
}

const gridError = (place: number, what: string) => sectionError('seed_grid', `the grid at ${place}: ${what}`);

/** The number of voxels of a grid whose header is right and whose words are all there. */
function voxelCount(words: Uint32Array, place: number): number {
    if (place + kSeedGridHeader > words.length) throw gridError(place, 'is cut off');
    const floats = new Float32Array(words.buffer, words.byteOffset + 4 * place, 6);
    const sizes = words.subarray(place + 6, place + 9);
    if (!floats.every(Number.isFinite) || floats.subarray(3).some(scale => scale < 0)) {
        throw gridError(place, 'has a box that is not finite');
    }
    if (sizes.some(size => size === 0 || size > kLongestSide)) throw gridError(place, `has ${sizes.join(' × ')} voxels`);
    if (words[place + 9] !== 0) throw gridError(place, 'has a reserved word that is not zero');
    const count = sizes[0] * sizes[1] * sizes[2];
    const room = words.length - place - kSeedGridHeader;
    if (count > room) throw gridError(place, `has ${count} voxels, room for ${room}`);
    return count;
}

function checkWord(words: Uint32Array, at: number, level: number, cellCount: number, levels: Map<number, number>): void {
    const word = words[at];
    if (word < kFinerGrid) {
        if (word >= cellCount) throw elementError('seed_grid', at, 'is out of range');
        return;
    }
    const finer = word - kFinerGrid;
    if (finer <= at || level === kSeedGridLevels) throw elementError('seed_grid', at, 'names a grid out of place');
    if ((levels.get(finer) ?? level + 1) !== level + 1) throw elementError('seed_grid', at, 'names a grid of another level');
    levels.set(finer, level + 1);
}
