// SPDX-License-Identifier: Apache-2.0
// The light of probes, and its weighted sums.
import {floatOfHalf} from './half.js';
import {kCoefficients} from './sh.js';
import {kNone, VolumeData} from './volume_data.js';

/** What queries read of a baked volume. */
export interface ProbeLight {
    irradiance: Float32Array;  // 27 a probe; empty: all light is ambient
    occlusion: Float32Array;   // 4 a probe; empty: 1
    ambient: Float32Array;     // 27
}

/** Full: if the file has that, otherwise half. Half: if the file has that, otherwise full. */
export type Precision = 'full' | 'half';

/** From the floats or the halves of a file. */
export function readProbeLight(volume: VolumeData, precision: Precision): ProbeLight {
    const {irradiance, occlusion, compact, info} = volume;
    const isFull = compact.length === 0 || (precision === 'full' && irradiance.length > 0);
    if (isFull) return {irradiance, occlusion, ambient: info.ambient};
    const count = compact.length / 32;
    const light = {irradiance: new Float32Array(27 * count), occlusion: new Float32Array(4 * count), ambient: info.ambient};
    for (let i = 0; i < count; ++i) {
        for (let k = 0; k < 27; ++k) light.irradiance[27 * i + k] = floatOfHalf(compact[32 * i + k]) * info.compactScale;
        for (let k = 0; k < 4; ++k) light.occlusion[4 * i + k] = floatOfHalf(compact[32 * i + 27 + k]);
    }
    return light;
}

/** Writes Σ weight · light of the cell's vertices + ambient · ambient light: the 27 numbers from `to` on. */
export function blendIrradiance(cells: Uint32Array, {irradiance, ambient}: ProbeLight, cell: number, weights: Float64Array,
                                share: number, out: Float32Array, to: number): void {
    if (cell === kNone || irradiance.length === 0) {
        out.set(ambient, to);
        return;
    }
    const at = 8 * cell;
    const first = cells[at];
    const w0 = weights[0], w1 = weights[1], w2 = weights[2], w3 = weights[3];
    // Places without a vertex have weight 0, and any light will do.
    const a = first * kCoefficients;
    const b = (w1 === 0 ? first : cells[at + 1]) * kCoefficients;
    const c = (w2 === 0 ? first : cells[at + 2]) * kCoefficients;
    const d = (w3 === 0 ? first : cells[at + 3]) * kCoefficients;
    for (let k = 0; k < kCoefficients; ++k) {
        out[to + k] = w0 * irradiance[a + k] + w1 * irradiance[b + k] + w2 * irradiance[c + k] + w3 * irradiance[d + k];
    }
    if (share === 0) return;
    for (let k = 0; k < kCoefficients; ++k) out[to + k] += share * ambient[k];
}

/** The same for the four channels of occlusion: 1 = lit. */
export function blendOcclusion(cells: Uint32Array, {occlusion}: ProbeLight, cell: number, weights: Float64Array,
                               share: number, out: Float32Array, to: number): void {
    if (cell === kNone || occlusion.length === 0) {
        out.fill(1, to, to + 4);
        return;
    }
    for (let k = 0; k < 4; ++k) {
        let sum = share;
        for (let i = 0; i < 4; ++i) {
            if (weights[i] > 0) sum += weights[i] * occlusion[4 * cells[8 * cell + i] + k];
        }
        out[to + k] = sum;
    }
}
