// SPDX-License-Identifier: Apache-2.0
// Weights that know walls: corner i of a cell sees a position with the barycentric weights b if L_i = Σ_j b_j r_ij ≤ 1,
// where r_ij is the length of edge i → j over the distance from probe i at which a wall blocks it (docs/how_to_query.md).
import {kNone, VolumeData} from './volume_data.js';

/** Bytes: twelve codes of edge ratios, two of splits. */
export const kElementSize = 14;

/** The code of ratio 1. Larger codes are edges that a wall blocks. */
export const kUnknownEdge = 67;

/** Hidden corners keep this share of their weights / L². */
const kHiddenShare = 0.01;

/** Weights fall from 1 to the share of hidden corners over L = 1 … 1.03. */
const kRamp = 0.03;

const kLeast = 2 ** -126;  // all weights may be 0

/** Edge ratio − 1 of each code. */
const kExcess = Float64Array.from({length: 256}, (_, code) => (code - kUnknownEdge) * Math.abs(code - kUnknownEdge) / 896);

/** The first byte of a cell's element of `cell_visibility`; `kNone` if nothing hides its corners. */
export function findVisibility({visibilityBlocks, cellVisibility}: VolumeData, cell: number): number {
    const at = cell >>> 5 << 1;
    if (at >= visibilityBlocks.length) return kNone;
    const marked = visibilityBlocks[at + 1];
    const bit = 1 << (cell & 31);
    if ((marked & bit) === 0) return kNone;
    const place = kElementSize * (visibilityBlocks[at] + bitCount(marked & bit - 1));
    return place < cellVisibility.length ? place : kNone;
}

function bitCount(x: number): number {
    x -= x >>> 1 & 0x55555555;
    x = (x & 0x33333333) + (x >>> 2 & 0x33333333);
    return Math.imul(x + (x >>> 4) & 0x0f0f0f0f, 0x01010101) >>> 24;
}

/** Of one corner: what is seen, and what is hidden over L² and L⁸. */
const kSeen = 0, kLow = 4, kSteep = 8;

export class EdgeVisibility {
    private readonly parts = new Float64Array(12);

    /**
     * Multiplies the weights of a cell by what its corners see, and keeps their sum. `distances` are those to the
     * corners, metres: behind a wall the light of hidden corners fades over `radius`.
     */
    hide(codes: Uint8Array, at: number, weights: Float64Array, radius: number, distances: Float64Array): void {
        const {parts} = this;
        const sum = weights[0] + weights[1] + (weights[2] + weights[3]);
        const unit = 1 / Math.max(sum, kLeast);
        const splits = codes[at + 12] | codes[at + 13] << 8;
        for (let i = 0; i < 4; ++i) {
            const b0 = weights[i + 1 & 3], b1 = weights[i + 2 & 3], b2 = weights[i + 3 & 3];
            const t0 = b0 * kExcess[codes[at + i]];
            const t1 = b1 * kExcess[codes[at + 4 + i]];
            const t2 = b2 * kExcess[codes[at + 8 + i]];
            const split = splits >>> i & 0x111;
            const others = split === 0 ? 0 : otherWalls(b0 + t0, b1 + t1, b2 + t2, split);
            const beyond = Math.max((t0 + t1 + t2 - weights[i] - others) * unit, 0);
            const ratio = 1 + beyond;
            const ramp = radius > 0 ? Math.max(kRamp, radius * (ratio / Math.max(distances[i], kLeast))) : kRamp;
            const u = Math.min(beyond / ramp, 1);
            const part = u * u * (3 - 2 * u);
            const hidden = weights[i] * part;
            const square = 1 / (ratio * ratio);
            parts[kSeen + i] = weights[i] * (1 - part);
            parts[kLow + i] = hidden * square;
            parts[kSteep + i] = hidden * square * square * square * square;
        }
        this.share(weights, sum);
    }

    /** Gives hidden corners a hundredth of the weight that walls took (`low`), in proportion to `steep`. */
    private share(weights: Float64Array, sum: number): void {
        const {parts: p} = this;
        const low = p[kLow] + p[kLow + 1] + (p[kLow + 2] + p[kLow + 3]);
        if (low === 0) return;  // all corners see the position
        const steep = p[kSteep] + p[kSteep + 1] + (p[kSteep + 2] + p[kSteep + 3]);
        const share = kHiddenShare * low / Math.max(steep, kLeast);
        for (let i = 0; i < 4; ++i) weights[i] = p[kSeen + i] + share * p[kSteep + i];
        const scale = sum / Math.max(weights[0] + weights[1] + (weights[2] + weights[3]), kLeast);
        for (let i = 0; i < 4; ++i) weights[i] *= scale;
    }
}

/**
 * What the sum of all walls has beyond that of the one that hides most: the least sum of parts without which no two edges
 * of different walls are left. Bits of `split`: edges 0 and 1, 0 and 2, 1 and 2 (bits 0, 4, 8).
 */
function otherWalls(part0: number, part1: number, part2: number, split: number): number {
    const a = Math.max(part0, 0), b = Math.max(part1, 0), c = Math.max(part2, 0);
    let least = Math.min(a + b, a + c, b + c);
    if ((split & 0x100) === 0) least = Math.min(least, a);
    if ((split & 0x10) === 0) least = Math.min(least, b);
    if ((split & 1) === 0) least = Math.min(least, c);
    return least;
}
