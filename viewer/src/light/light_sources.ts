// SPDX-License-Identifier: Apache-2.0
// Where the light of a place comes from, and how bright it is beside that of all probes.
import {kCoefficients, Light, Volume} from 'tetralight';

import {ambientOf} from './answers';
import {luminance} from './radiometry';

export interface LightShare {
    layer: string;
    share: number;
}

/** The share of each layer in the light of a place by its mean over all directions, the first three coefficients, with the weights of now; empty without layers or light. */
export function lightShares({layers, data: {layers: stored, layerIrradiance}}: Volume,
                            {probes, weights, ambient}: Light): LightShare[] {
    const each = layerIrradiance.length / Math.max(1, layers.length);
    const parts = layers.map(({weight}, k) => weight * probes.reduce(
        (sum, probe, i) => sum + weights[i] * luminance(layerIrradiance, k * each + kCoefficients * probe),
        ambient * luminance(stored[k].ambient)));
    const sum = parts.reduce((a, b) => a + b, 0);
    return sum > 0 ? layers.map(({name}, k) => ({layer: name, share: parts[k] / sum})) : [];
}

const means = new WeakMap<Float32Array, number>();  // many queries are of one volume

function meanOfProbes(volume: Volume): number {
    const {irradiance} = volume;
    if (!means.has(irradiance)) means.set(irradiance, luminance(ambientOf(volume)));
    return means.get(irradiance)!;
}

/** "1.9 stops darker than the mean of all probes: 71 % sky, 29 % sun."; nothing where no light is. */
export function sourceWords(volume: Volume, light: Light): string {
    const stops = Math.log2(luminance(light.sh) / meanOfProbes(volume));
    if (!Number.isFinite(stops)) return '';
    const size = Math.abs(stops).toFixed(1);
    const beside = size === '0.0' ? 'As bright as' : `${size} stops ${stops < 0 ? 'darker' : 'brighter'} than`;
    const shares = lightShares(volume, light).sort((a, b) => b.share - a.share)
        .map(({layer, share}) => `${Math.round(100 * share)} % ${layer.slice(layer.indexOf(':') + 1)}`);
    return `${beside} the mean of all probes${shares.length === 0 ? '' : `: ${shares.join(', ')}`}.`;
}
