// SPDX-License-Identifier: Apache-2.0
// Light that changes after the bake: the weighted sum of layers (docs/relighting.md).
import type {ProbeLight} from './blend.js';
import {kLargestCoefficient} from './checks.js';
import {argumentError, TetralightError} from './error.js';
import type {LayeredLight} from './relight.js';
import {kCoefficients} from './sh.js';

/** Weights by layer: its full name, or the part after the colon. */
export type LayerWeights = Readonly<Record<string, number>>;

/** The weights with some of them replaced. */
export function changedWeights(names: readonly string[], weights: readonly number[], changes: LayerWeights): number[] {
    const changed = [...weights];
    const seen = new Set<number>();
    for (const [name, weight] of Object.entries(changes)) {
        const layer = findLayer(names, name);
        if (!(weight >= 0 && weight < Infinity)) {
            throw argumentError('weights', `of layer "${name}": ${weight} is not a finite number that is 0 or more`);
        }
        if (seen.has(layer)) throw argumentError('weights', `name layer "${name}" twice`);
        seen.add(layer);
        changed[layer] = weight;
    }
    return changed;
}

function findLayer(names: readonly string[], name: string): number {
    const exact = names.indexOf(name);
    if (exact >= 0) return exact;
    const isShort = (layer: string) => layer.includes(':') && layer.slice(layer.indexOf(':') + 1) === name;
    const found = names.findIndex(isShort);
    const count = names.filter(isShort).length;
    if (count === 1) return found;
    const listed = names.length === 0 ? 'it holds no layers' : `it holds ${names.map(layer => `"${layer}"`).join(', ')}`;
    throw new TetralightError(count === 0 ? 'not_found' : 'invalid_argument', 'weights',
                              `${count === 0 ? 'there is no layer' : 'there are several layers'} "${name}"; ${listed}`);
}

/** The light of a volume as Σ weight · layer. */
export function recombine({layers, layerIrradiance}: LayeredLight, weights: readonly number[],
                          occlusion: Float32Array): ProbeLight {
    if (layers.length === 0 || layerIrradiance.length === 0) {
        throw argumentError('weights', 'change nothing: the volume holds no layers (bake it with --layers)');
    }
    const bound = (size: (k: number) => number) => weights.reduce((sum, weight, k) => sum + weight * size(k), 0);
    const brightest = Math.max(bound(k => layers[k].largest), bound(k => Math.max(...layers[k].ambient.map(Math.abs))));
    if (!(brightest < kLargestCoefficient)) throw argumentError('weights', 'make the light too bright to be finite');
    const each = layerIrradiance.length / layers.length;
    const irradiance = new Float32Array(each);
    const ambient = new Float32Array(kCoefficients);
    weights.forEach((weight, k) => {
        addScaled(irradiance, weight, layerIrradiance.subarray(k * each, (k + 1) * each));
        addScaled(ambient, weight, layers[k].ambient);
    });
    return {irradiance, ambient, occlusion};
}

function addScaled(sum: Float32Array, weight: number, part: Float32Array): void {
    if (weight === 0) return;
    for (let i = 0; i < sum.length; ++i) sum[i] += weight * part[i];
}
