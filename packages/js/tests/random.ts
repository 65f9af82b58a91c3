// SPDX-License-Identifier: Apache-2.0
import type {Volume} from '../src/volume.js';

/** Numbers from 0 to 1 that are the same in every run (Mulberry32). */
export function makeRandom(seed: number): () => number {
    let state = seed;
    return () => {
        state = state + 0x6d2b79f5 | 0;
        let mixed = Math.imul(state ^ state >>> 15, 1 | state);
        mixed = mixed + Math.imul(mixed ^ mixed >>> 7, 61 | mixed) ^ mixed;
        return ((mixed ^ mixed >>> 14) >>> 0) / 2 ** 32;
    };
}

/** The largest |number|. */
export function largestOf(numbers: ArrayLike<number>): number {
    let largest = 0;
    for (let i = 0; i < numbers.length; ++i) largest = Math.max(largest, Math.abs(numbers[i]));
    return largest;
}

/**
 * Positions among the probes of a volume, around them and far away, and on some of the probes: three floats each.
 */
export function makePositions(volume: Volume, count: number, seed: number): Float32Array {
    const random = makeRandom(seed);
    const probes = Array.from({length: volume.probeCount}, (_, i) => volume.position(i));
    const low = [0, 1, 2].map(axis => probes.reduce((least, p) => Math.min(least, p[axis]), Infinity));
    const high = [0, 1, 2].map(axis => probes.reduce((most, p) => Math.max(most, p[axis]), -Infinity));
    const positions = new Float32Array(3 * count);
    for (let i = 0; i < count; ++i) {
        const reach = i % 10 === 0 ? 1e5 : i % 5 === 0 ? 4 : 1;
        const probe = i % 17 === 0 ? probes[Math.floor(random() * probes.length)] : undefined;
        for (let axis = 0; axis < 3; ++axis) {
            const middle = (low[axis] + high[axis]) / 2;
            const half = (high[axis] - low[axis]) / 2 + 0.5;
            positions[3 * i + axis] = probe ? probe[axis] : middle + (2 * random() - 1) * half * reach;
        }
    }
    return positions;
}
