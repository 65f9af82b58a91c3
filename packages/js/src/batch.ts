// SPDX-License-Identifier: Apache-2.0
// Many positions in one call, into arrays of the caller: nothing is allocated for a position.
import {blendIrradiance, blendOcclusion, ProbeLight} from './blend.js';
import {argumentError} from './error.js';
import type {Query} from './query.js';
import {checkLength, kAllRenderingLayers, QueryOptions, QuerySettings, readSettings} from './query_options.js';
import {kCoefficients, kPacked, packSh} from './sh.js';
import {kNone, VolumeData} from './volume_data.js';

/** Where answers go; each is optional. Arrays may be longer than the positions need. */
export interface BatchOutputs {
    /** 27 floats each: coefficients of irradiance. */
    sh?: Float32Array;
    /** 28 floats each: the seven vec4 of `packSh`, for shaders. */
    packed?: Float32Array;
    /** 4 floats each. */
    occlusion?: Float32Array;
    /** In: where each walk begins (`kNone`: at the seed grid). Out: the cell, for the next frame. */
    hints?: Uint32Array;
    /** 4 floats each: barycentric weights of the cell's vertices, before walls. */
    weights?: Float32Array;
    /** The fraction of ambient light. */
    ambient?: Float32Array;
}

/** As of single queries; what differs between positions is in arrays. */
export interface BatchOptions extends Omit<QueryOptions, 'hint' | 'normal' | 'radius' | 'renderingLayers'> {
    /** Of all, or one a position. */
    radius?: number | ArrayLike<number>;
    renderingLayers?: number | ArrayLike<number>;
    /** 3 numbers a position. */
    normals?: ArrayLike<number>;
}

/** Values of all positions or of each. */
type Varying = (i: number) => number;

export function answerBatch(volume: VolumeData, light: ProbeLight, query: Query, positions: ArrayLike<number>,
                            outputs: BatchOutputs, options: BatchOptions): void {
    const count = checkBatch(positions, outputs, options);
    const {radius = 0, renderingLayers = kAllRenderingLayers, normals, ...common} = options;
    const settings = readSettings(common);
    const radiusOf = varying('radius', radius, count, length => checkLength('radius', length));
    const layersOf = varying('renderingLayers', renderingLayers, count, () => {});
    const write = new Writer(volume.cells, light, outputs);
    for (let i = 0; i < count; ++i) {
        const x = positions[3 * i], y = positions[3 * i + 1], z = positions[3 * i + 2];
        const hint = outputs.hints ? outputs.hints[i] : kNone;
        if (normals) {
            locateOffSurface(query, [x, y, z], [normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]], hint, settings);
        } else {
            query.locate(x, y, z, hint, settings);
        }
        write.location(query, i);
        query.hide(settings, radiusOf(i), layersOf(i) >>> 0);
        write.light(query, i);
    }
}

/** Locates a position that is pushed off its surface, so that a wall takes the light of its own side. */
export function locateOffSurface(query: Query, position: ArrayLike<number>, normal: ArrayLike<number>, hint: number,
                                 settings: QuerySettings): void {
    query.locate(position[0], position[1], position[2], hint, {...settings, outside: 'extrapolate'});
    const distance = query.pushDistance(settings);
    // Rounded, as in languages whose positions are floats.
    query.locate(Math.fround(position[0] + distance * normal[0]), Math.fround(position[1] + distance * normal[1]),
                 Math.fround(position[2] + distance * normal[2]), query.cell, settings);
}

function checkBatch(positions: ArrayLike<number>, outputs: BatchOutputs, {normals}: BatchOptions): number {
    if (!(positions?.length >= 0)) throw argumentError('positions', 'is not an array of numbers');
    if (!outputs) throw argumentError('outputs', 'is missing: where answers go');
    if (positions.length % 3 !== 0) throw argumentError('positions', `has ${positions.length} numbers, not three each`);
    const count = positions.length / 3;
    const sizes = {sh: kCoefficients, packed: kPacked, occlusion: 4, hints: 1, weights: 4, ambient: 1} as const;
    for (const [name, size] of Object.entries(sizes) as [keyof BatchOutputs, number][]) {
        const length = outputs[name]?.length ?? Infinity;
        if (length < size * count) throw argumentError(name, `has ${length} elements, but ${size * count} are needed`);
    }
    if (normals && normals.length < 3 * count) {
        throw argumentError('normals', `has ${normals.length} numbers, but there are ${count} positions`);
    }
    return count;
}

function varying(name: string, values: number | ArrayLike<number>, count: number, check: (value: number) => void): Varying {
    if (typeof values === 'number') {
        check(values);
        return () => values;
    }
    if (values.length < count) throw argumentError(name, `has ${values.length} elements, but there are ${count} positions`);
    for (let i = 0; i < count; ++i) check(values[i]);
    return i => values[i];
}

/** Writes answer i to its place in each output. */
class Writer {
    private readonly sum = new Float32Array(kCoefficients);

    constructor(private readonly cells: Uint32Array, private readonly probes: ProbeLight,
                private readonly outputs: BatchOutputs) {}

    location({cell, weights, ambient}: Query, i: number): void {
        const {outputs} = this;
        if (outputs.hints) outputs.hints[i] = cell;
        if (outputs.ambient) outputs.ambient[i] = ambient;
        if (outputs.weights) outputs.weights.set(weights, 4 * i);
    }

    light({cell, weights, ambient}: Query, i: number): void {
        const {cells, probes, sum, outputs: {sh, packed, occlusion}} = this;
        if (sh) blendIrradiance(cells, probes, cell, weights, ambient, sh, kCoefficients * i);
        if (packed) {
            blendIrradiance(cells, probes, cell, weights, ambient, sum, 0);
            packSh(sum, 0, packed, kPacked * i);
        }
        if (occlusion) blendOcclusion(cells, probes, cell, weights, ambient, occlusion, 4 * i);
    }
}
