// SPDX-License-Identifier: Apache-2.0
// The seed grid: a cell near each position, found by two or three reads (docs/file_format.md#the-seed-grid).

export const kSeedGridHeader = 10;  // words
export const kSeedGridLevels = 4;

/** The word of a voxel with this bit names a finer grid. */
export const kFinerGrid = 0x80000000;

export class SeedGrid {
    private readonly floats: Float32Array;

    constructor(private readonly words: Uint32Array) {
        this.floats = new Float32Array(words.buffer, words.byteOffset, words.length);
    }

    /** The cell where a walk to a local position begins; 0 without a grid. */
    find(x: number, y: number, z: number): number {
        const {words, floats} = this;
        let place = 0;
        for (let level = 0; level < kSeedGridLevels && place + kSeedGridHeader <= words.length; ++level) {
            const i = voxel((x - floats[place]) * floats[place + 3], words[place + 6]);
            const j = voxel((y - floats[place + 1]) * floats[place + 4], words[place + 7]);
            const k = voxel((z - floats[place + 2]) * floats[place + 5], words[place + 8]);
            const word = words[place + kSeedGridHeader + (k * words[place + 7] + j) * words[place + 6] + i];
            if (word < kFinerGrid) return word;
            place = word - kFinerGrid;
        }
        return 0;
    }
}

/** The voxel along one axis that is nearest; 0 if that is not a number. */
function voxel(along: number, size: number): number {
    return along > 0 ? (along < size ? along | 0 : size - 1) : 0;
}
