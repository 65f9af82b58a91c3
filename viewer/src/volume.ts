// SPDX-License-Identifier: Apache-2.0
// A probe volume as arrays, read from the sections of its file (docs/file_format.md).
import type {Api, StoredFile} from './api';
import type {Locations} from './query_binary';
import {kCoefficients} from './sh';
import {readLights, VolumeLight} from './volume_lights';

export const kNone = 0xffffffff;
const kY0 = 0.5 / Math.sqrt(Math.PI);  // the constant basis function

export interface Layer {
    name: string;
    weight: number;
    irradiance: Float32Array;
}

export interface Health {
    error: number;
    surface: number;
    offset: number;
    isDilated: boolean;
}

export interface Volume {
    file: StoredFile;
    probeCount: number;
    innerCellCount: number;
    positions: Float32Array;   // world, 3 a probe
    irradiance: Float32Array;  // 27 a probe; zeros when it was never baked
    isBaked: boolean;
    ambient: Float32Array;     // 27
    cells: Uint32Array;        // 8 a cell: vertices, neighbors
    validity: Float32Array;    // none: all valid
    health: Health[];          // none: not known
    layers: Layer[];
    layerAmbients: Float32Array[];
    lights: VolumeLight[];
    sky: number[] | null;      // mean radiance of layer "sky"; none: not known
    sources: Uint32Array;      // 3 each: group, index in the group, probe
    groupNames: string[];
    exactPositions: Float64Array;
    renderingLayers: Uint32Array;  // masks, one a probe; none: all are on all layers
}

/** The first bytes of section `info`: `VolumeInfo`. */
export function readInfo(bytes: ArrayBuffer) {
    const view = new DataView(bytes);
    return {
        origin: [0, 8, 16].map(offset => view.getFloat64(offset, true)),
        dimension: view.getUint32(80, true),
        innerCellCount: view.getUint32(84, true),
        ambient: new Float32Array(bytes.slice(92, 200)),
    };
}

/** `layers` has 124 bytes each: weight, largest coefficient, 27 floats of ambient light, padding. */
export function readLayers(bytes: ArrayBuffer, names: string[], irradiance: Float32Array) {
    const size = names.length === 0 ? 0 : bytes.byteLength / names.length;
    const each = names.length === 0 ? 0 : irradiance.length / names.length;
    const view = new DataView(bytes);
    const layers = names.map((name, i) => ({
        name,
        weight: view.getFloat32(i * size, true),
        irradiance: irradiance.subarray(i * each, (i + 1) * each),
    }));
    const ambients = names.map((_, i) => new Float32Array(bytes.slice(i * size + 8, i * size + 116)));
    return {layers, ambients};
}

export function readHealth(bytes: ArrayBuffer): Health[] {
    const view = new DataView(bytes);
    const health: Health[] = [];
    for (let at = 0; at + 24 <= bytes.byteLength; at += 24) {
        const offset = [8, 12, 16].map(i => view.getFloat32(at + i, true));
        health.push({
            error: view.getFloat32(at, true),
            surface: view.getFloat32(at + 4, true),
            offset: Math.hypot(...offset),
            isDilated: view.getUint32(at + 20, true) !== 0,
        });
    }
    return health;
}

const lines = (bytes: ArrayBuffer) => new TextDecoder().decode(bytes).split('\n').slice(0, -1);

export async function readVolume(api: Api, file: StoredFile): Promise<Volume> {
    const section = (name: string) => api.bytes(`/v1/volumes/${file.id}/sections/${name}`);
    const names = ['info', 'positions', 'irradiance', 'cells', 'validity', 'health', 'layers',
                   'layer_names', 'layer_irradiance', 'sources', 'group_names', 'exact_positions', 'lights',
                   'light_states', 'sky', 'rendering_layers'];
    const present = sectionNames(file);
    const read = await Promise.all(
        names.map(name => present.has(name) ? section(name) : new ArrayBuffer(0)));
    const get = (name: string) => read[names.indexOf(name)];

    const info = readInfo(get('info'));
    const positions = new Float32Array(get('positions'));
    for (let i = 0; i < positions.length; ++i) positions[i] += info.origin[i % 3];
    const irradiance = new Float32Array(get('irradiance'));
    const probeCount = positions.length / 3;
    const {layers, ambients} = readLayers(get('layers'), lines(get('layer_names')),
                                          new Float32Array(get('layer_irradiance')));
    return {
        file, probeCount, positions, layers,
        innerCellCount: info.innerCellCount,
        irradiance: irradiance.length > 0 ? irradiance : new Float32Array(kCoefficients * probeCount),
        isBaked: irradiance.length > 0,
        ambient: info.ambient,
        cells: new Uint32Array(get('cells')),
        validity: new Float32Array(get('validity')),
        health: readHealth(get('health')),
        layerAmbients: ambients,
        lights: readLights(get('lights'), get('light_states')),
        sky: present.has('sky') ? [...new Float32Array(get('sky'), 0, 3)].map(value => kY0 * value) : null,
        sources: new Uint32Array(get('sources')),
        groupNames: lines(get('group_names')),
        exactPositions: new Float64Array(get('exact_positions')),
        renderingLayers: new Uint32Array(get('rendering_layers')),
    };
}

/** Empty sections are left out of files. */
function sectionNames(file: StoredFile): Set<string> {
    return new Set(Object.keys((file.facts?.section_bytes ?? {}) as Record<string, number>));
}

/** Σ weight · layer, added to nothing: the light of other weights. Without layers, the light as it is. */
export function sumLayers(volume: Volume, weights: readonly number[]): Float32Array {
    if (volume.layers.length === 0) return volume.irradiance;
    const sum = new Float32Array(volume.irradiance.length);
    volume.layers.forEach((layer, i) => {
        const weight = weights[i];
        if (weight === 0) return;
        for (let k = 0; k < sum.length; ++k) sum[k] += weight * layer.irradiance[k];
    });
    return sum;
}

export function sumAmbient(volume: Volume, weights: readonly number[]): Float32Array {
    if (volume.layers.length === 0) return volume.ambient;
    const sum = new Float32Array(kCoefficients);
    volume.layerAmbients.forEach((ambient, i) => {
        for (let k = 0; k < sum.length; ++k) sum[k] += weights[i] * ambient[k];
    });
    return sum;
}

export interface Light {
    irradiance: Float32Array;
    ambient: Float32Array;
}

/** The light at a located place: what the server's `interpolate` gives, from the light given here. */
export function blend(volume: Volume, light: Light, places: Locations, i: number, sh: Float32Array,
                      at: number): void {
    const cell = places.cells[i];
    const share = cell === kNone ? 1 : places.ambient[i];
    for (let k = 0; k < kCoefficients; ++k) sh[at + k] = share * light.ambient[k];
    if (cell === kNone) return;
    for (let corner = 0; corner < 4; ++corner) {
        const probe = volume.cells[8 * cell + corner];
        const weight = places.weights[4 * i + corner];
        if (probe === kNone || weight === 0) continue;
        const from = probe * kCoefficients;
        for (let k = 0; k < kCoefficients; ++k) sh[at + k] += weight * light.irradiance[from + k];
    }
}

/** The probes at the corners of a cell: fewer than four in hull cells. */
export function cornersOf(cells: Uint32Array, cell: number): number[] {
    if (cell === kNone) return [];
    return [...cells.subarray(8 * cell, 8 * cell + 4)].filter(probe => probe !== kNone);
}

export interface Edges {
    inner: Uint32Array;  // two probes an edge
    hull: Uint32Array;
}

/** Every edge once; those of the hull apart. */
export function edgesOf(cells: Uint32Array, innerCellCount: number): Edges {
    const cellCount = cells.length / 8;
    const hull = uniqueEdges(cells, innerCellCount, cellCount);
    const inner = uniqueEdges(cells, 0, innerCellCount);
    const onHull = new Set(hull);
    return {inner: pairs(inner.filter(key => !onHull.has(key))), hull: pairs(hull)};
}

const kKey = 2 ** 26;

function uniqueEdges(cells: Uint32Array, begin: number, end: number): Float64Array {
    const keys = new Float64Array((end - begin) * 6);
    let count = 0;
    for (let cell = begin; cell < end; ++cell) {
        for (let a = 0; a < 3; ++a) {
            for (let b = a + 1; b < 4; ++b) {
                const i = cells[8 * cell + a];
                const j = cells[8 * cell + b];
                if (i === kNone || j === kNone) continue;
                keys[count++] = Math.min(i, j) * kKey + Math.max(i, j);
            }
        }
    }
    return keys.subarray(0, count).sort().filter((key, i, all) => i === 0 || key !== all[i - 1]);
}

function pairs(keys: Float64Array): Uint32Array {
    const ends = new Uint32Array(keys.length * 2);
    keys.forEach((key, i) => {
        ends[2 * i] = Math.floor(key / kKey);
        ends[2 * i + 1] = key % kKey;
    });
    return ends;
}
