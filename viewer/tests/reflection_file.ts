// SPDX-License-Identifier: Apache-2.0
// Files of reflection probes as docs/file_format.md lays them out, with light that no bake would find.
import * as three from 'three';

const kHeader = 80;
const kLevelEntry = 24;
const kDescriptor = 44;
const kProbe = 216;
const kWeightedLayer = 16;
const kCoefficientBytes = 27 * 4;

export interface ProbeSetup {
    position: number[];
    box: {center: number[]; half_size: number[]; axes: number[][]} | null;
    blend_distance: number;
    importance: number;
    irradiance_sh: number[][];
}

/** A probe in a box along the axes of the world. Without irradiance no place is darker than the probe. */
export function probeAt(position: number[], low: number[], high: number[], more: Partial<ProbeSetup> = {}): ProbeSetup {
    const box = {center: low.map((x, i) => (x + high[i]) / 2 - position[i]), half_size: low.map((x, i) => (high[i] - x) / 2),
                 axes: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]};
    return {position, box, blend_distance: 0.25, importance: 1,
            irradiance_sh: Array.from({length: 9}, () => [0, 0, 0]), ...more};
}

function probeBytes({position, box, blend_distance, importance, irradiance_sh}: ProbeSetup): Uint8Array {
    const bytes = new Uint8Array(kProbe);
    const view = new DataView(bytes.buffer);
    const floats = (at: number, values: number[]) => values.forEach((x, i) => view.setFloat32(at + 4 * i, x, true));
    const {center, half_size, axes} =
        box ?? {center: [0, 0, 0], half_size: [Infinity, Infinity, Infinity], axes: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]};
    position.forEach((x, i) => view.setFloat64(8 * i, x, true));
    floats(24, [...center, ...half_size, ...axes.flat(), blend_distance]);
    view.setInt32(88, importance, true);
    floats(92, [1, ...irradiance_sh.flat()]);
    return bytes;
}

function pair(key: string, value: Uint8Array): Uint8Array {
    const words = new TextEncoder().encode(`${key}\0`);
    const length = words.length + value.length;
    const bytes = new Uint8Array(4 + Math.ceil(length / 4) * 4);
    new DataView(bytes.buffer).setUint32(0, length, true);
    bytes.set(words, 4);
    bytes.set(value, 4 + words.length);
    return bytes;
}

/** Layers that are as bright as their probes. */
function layerPairs(probeCount: number, layerCount: number): Uint8Array[] {
    if (layerCount === 0) return [];
    const weights = new Uint8Array(kWeightedLayer * layerCount);
    for (let i = 0; i < layerCount; ++i) new DataView(weights.buffer).setFloat32(kWeightedLayer * i, 1, true);
    const names = Array.from({length: layerCount}, (_, i) => `layer ${i}\n`).join('');
    return [pair('tetralightLayerIrradiance', new Uint8Array(kCoefficientBytes * probeCount * layerCount)),
            pair('tetralightLayerNames', new TextEncoder().encode(names)), pair('tetralightLayers', weights)];
}

function joined(parts: Uint8Array[]): Uint8Array {
    const bytes = new Uint8Array(parts.reduce((sum, {length}) => sum + length, 0));
    let at = 0;
    for (const part of parts) {
        bytes.set(part, at);
        at += part.length;
    }
    return bytes;
}

/** A file of cubes with one level for each of `sides`: each face has one color, `color(cube, face, level)`. */
export function reflectionFile(probes: ProbeSetup[], sides: number[], cubeCount: number,
                               color: (cube: number, face: number, level: number) => number[]): ArrayBuffer {
    const pairs = joined([...layerPairs(probes.length, cubeCount / probes.length - 1),
                          pair('tetralightReflections', joined(probes.map(probeBytes)))]);
    const descriptor = kHeader + kLevelEntry * sides.length;
    const keys = descriptor + kDescriptor;
    const lengths = sides.map(side => 8 * side * side * 6 * cubeCount);
    const begin = Math.ceil((keys + pairs.length) / 8) * 8;
    const bytes = new ArrayBuffer(begin + lengths.reduce((sum, length) => sum + length));
    const view = new DataView(bytes);
    [0x58544bab, 0xbb303220, 0x0a1a0a0d, 97, 2, sides[0], sides[0], 0, cubeCount, 6, sides.length, 0, descriptor, kDescriptor,
     keys, pairs.length].forEach((word, i) => view.setUint32(4 * i, word, true));
    view.setUint32(descriptor, kDescriptor, true);
    new Uint8Array(bytes).set(pairs, keys);
    let at = begin;
    sides.forEach((side, level) => {
        [at, lengths[level], lengths[level]].forEach(
            (size, i) => view.setBigUint64(kHeader + kLevelEntry * level + 8 * i, BigInt(size), true));
        for (let texel = 0; texel < lengths[level] / 8; ++texel) {
            const face = Math.floor(texel / (side * side));
            [...color(Math.floor(face / 6), face % 6, level), 1].forEach(
                (x, c) => view.setUint16(at + 8 * texel + 2 * c, three.DataUtils.toHalfFloat(x), true));
        }
        at += lengths[level];
    });
    return bytes;
}
