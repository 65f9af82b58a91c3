// SPDX-License-Identifier: Apache-2.0
// Another sky or sun without another bake: by the transfer of each probe from distant light to its irradiance (Sloan, Kautz &
// Snyder 2002, "Precomputed Radiance Transfer"; docs/relighting.md).
import {argumentError, TetralightError} from './error.js';
import {dering} from './dering.js';
import {kDistantCoefficients} from './distant_light.js';
import {kCoefficients, kCosine, Vector} from './sh.js';
import type {StoredLayer, VolumeData} from './volume_data.js';

/** The layers of a volume with their light, which may differ from that of the file. */
export interface LayeredLight {
    readonly layers: readonly StoredLayer[];
    readonly layerIrradiance: Float32Array;  // layer after layer, 27 a probe
}

/** Floats of a transfer: of direct light to 9 coefficients from 16, and of bounces with channels. */
const kDirect = 9 * 16, kTransfer = kDirect + 9 * 16 * 3;

export function checkDistantLight(name: string, light: Vector): void {
    if (light.length !== kDistantCoefficients) {
        throw argumentError(name, `has ${light.length} numbers instead of ${kDistantCoefficients}`);
    }
    for (let i = 0; i < light.length; ++i) {
        if (!Number.isFinite(light[i])) throw argumentError(name, `is not finite: number ${i} is ${light[i]}`);
    }
}

/** The volume's layer of this name. Throws if it, or the transfer, is missing. */
export function layerToRelight({layerNames, transfer, sky, positions}: VolumeData, name: string): number {
    if (transfer.length !== kTransfer * (positions.length / 3) || sky.length !== kDistantCoefficients) {
        throw argumentError('transfer', 'is missing: bake the volume with the layers sky and transfer');
    }
    const layer = layerNames.indexOf(name);
    if (layer < 0) throw new TetralightError('not_found', 'layer', `the volume holds no layer "${name}" to relight`);
    return layer;
}

/** The only light of the layer "sun", by index. */
export function movableSun(volume: VolumeData): number {
    const layer = layerToRelight(volume, 'sun');
    const states = volume.lightStates;
    const suns = Array.from({length: states.length / 4}, (_, i) => i).filter(i => states[4 * i + 2] === layer);
    if (suns.length !== 1) throw argumentError('sun', `cannot be moved: layer "sun" holds ${suns.length} suns`);
    return suns[0];
}

/** The light with one layer replaced by what probes transfer of distant light: of the direct one, and of its bounces. */
export function relightLayer(volume: VolumeData, {layers, layerIrradiance}: LayeredLight, layer: number,
                             direct: Vector | undefined, bounced: Vector, ambient: Float32Array): LayeredLight {
    const size = volume.positions.length / 3 * kCoefficients;
    const light = layerIrradiance.slice();
    const part = light.subarray(layer * size, (layer + 1) * size);
    for (let probe = 0; probe < part.length / kCoefficients; ++probe) {
        transferLight(volume.transfer, kTransfer * probe, direct, bounced, part, kCoefficients * probe);
        const window = volume.dering[probe] ?? 0;
        if (window === 0) continue;
        dering(part, kCoefficients * probe, window - 1);
        for (let k = 0; k < 3; ++k) part[kCoefficients * probe + k] = Math.max(part[kCoefficients * probe + k], 0);
    }
    const largest = part.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
    return {layers: layers.map((old, i) => i === layer ? {...old, largest, ambient} : old), layerIrradiance: light};
}

function transferLight(transfer: Float32Array, at: number, direct: Vector | undefined, bounced: Vector, out: Float32Array,
                       to: number): void {
    for (let i = 0; i < 9; ++i) {
        for (let channel = 0; channel < 3; ++channel) {
            let sum = 0;
            for (let j = 0; j < 16; ++j) {
                const k = 16 * i + j;
                sum += transfer[at + kDirect + 3 * k + channel] * bounced[3 * j + channel];
                if (direct) sum += transfer[at + k] * direct[3 * j + channel];
            }
            out[to + 3 * i + channel] = sum;
        }
    }
}

/** What is far from everything sees all of the sky. */
export function openIrradiance(sky: Vector): Float32Array {
    return Float32Array.from({length: kCoefficients}, (_, i) => sky[i] * kCosine[Math.floor(i / 3)]);
}
