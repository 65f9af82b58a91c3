// SPDX-License-Identifier: Apache-2.0
// Files of reflection probes (docs/file_format.md), and which probes a mesh can see.
import * as three from 'three';

import {kHalf, readKtx2} from './ktx2';
import {kPacked, packSh} from './sh';

export interface ReflectionBox {
    center: three.Vector3;  // relative to the position, in world axes
    halfSize: three.Vector3;
    axes: three.Vector3[];
}

export interface ReflectionProbe {
    position: three.Vector3;
    box: ReflectionBox | null;  // null: used everywhere
    blendDistance: number;
    importance: number;
    irradiance: Float32Array;  // packed for shaders
}

/** Cubes of RGBA halves. */
export interface Reflections {
    size: number;  // texels along a side of a face
    levelCount: number;
    probes: ReflectionProbe[];
    /** The six faces of a level of a probe, in the order of OpenGL. */
    faces: (probe: number, level: number) => Uint16Array<ArrayBuffer>[];
}

interface ProbeJson {
    position: number[];
    box: {center: number[]; half_size: number[]; axes: number[][]} | null;
    blend_distance: number;
    importance: number;
    irradiance_sh: number[][];
}

const kFaces = 6;

/** The cubes of layers, which follow those of the probes, are not read: probes hold the sum of their layers. */
export function parseReflections(file: ArrayBuffer): Reflections {
    const {format, width, height, layerCount, faceCount, levels, keys} = readKtx2(file, 'the file of reflection probes');
    const words = keys.get('tetralight');
    const json = words === undefined ? {} : JSON.parse(words) as {probes?: ProbeJson[]};
    if (json.probes === undefined || faceCount !== kFaces || width !== height) {
        throw new Error('the file has no reflection probes');
    }
    if (format !== kHalf) throw new Error(`the reflection probes have texels of format ${format}`);
    const {length} = json.probes;
    if (length > layerCount) throw new Error(`the file has cubes for ${layerCount} of ${length} probes`);
    levels.forEach((bytes, level) => {
        const side = width >> level;
        if (bytes.byteLength !== 8 * side * side * kFaces * layerCount) {
            throw new Error(`level ${level} of the reflection probes has ${bytes.byteLength} bytes`);
        }
    });
    const faces = (probe: number, level: number) => {
        const texels = (width >> level) ** 2;
        return Array.from({length: kFaces}, (_, face) =>
            new Uint16Array(levels[level], 8 * texels * (kFaces * probe + face), 4 * texels));
    };
    return {size: width, levelCount: levels.length, probes: json.probes.map(probeOf), faces};
}

function probeOf(json: ProbeJson): ReflectionProbe {
    const irradiance = new Float32Array(kPacked);
    packSh(json.irradiance_sh.flat(), 0, irradiance, 0);
    const vector = (numbers: number[]) => new three.Vector3().fromArray(numbers);
    const box = json.box === null ? null : {
        center: vector(json.box.center), halfSize: vector(json.box.half_size), axes: json.box.axes.map(vector)};
    return {position: vector(json.position), box, blendDistance: json.blend_distance, importance: json.importance,
            irradiance};
}

/** The order in which probes cover each other: importance, then small boxes first, then their order in the file.
 * The twin of `reflection_order` of reflection/sample_reflections.h. */
export function reflectionOrder(probes: ReflectionProbe[]): number[] {
    const volumes = probes.map(({box}) => box === null ? Infinity : box.halfSize.x * box.halfSize.y * box.halfSize.z);
    const compare = (a: number, b: number) => a < b ? -1 : Number(a > b);  // of infinities, too
    return probes.map((_, i) => i).sort((a, b) =>
        probes[b].importance - probes[a].importance || compare(volumes[a], volumes[b]) || a - b);
}

/** The `count` probes that surfaces in a world box see the most likely, in the order in which they cover each other:
 * those that are everywhere, then those with the nearest boxes. */
export function probesNear(probes: ReflectionProbe[], box: three.Box3, count: number): number[] {
    const order = reflectionOrder(probes);
    const distances = probes.map(probe => probe.box === null ? -1 : distanceBetween(worldBoxOf(probe, probe.box), box));
    const near = new Set([...order].sort((a, b) => distances[a] - distances[b]).slice(0, count));
    return order.filter(probe => near.has(probe));
}

/** The world axes' box around where a probe counts. */
function worldBoxOf({position, blendDistance}: ReflectionProbe, {center, halfSize, axes}: ReflectionBox): three.Box3 {
    const kReach = 1.001;  // tetralight_box_reach
    const half = new three.Vector3().setScalar(blendDistance);
    axes.forEach((axis, i) => {
        const length = kReach * halfSize.getComponent(i);
        half.add(new three.Vector3(Math.abs(axis.x), Math.abs(axis.y), Math.abs(axis.z)).multiplyScalar(length));
    });
    const middle = position.clone().add(center);
    return new three.Box3(middle.clone().sub(half), middle.clone().add(half));
}

function distanceBetween(a: three.Box3, b: three.Box3): number {
    const gap = (low: number, high: number, otherLow: number, otherHigh: number) =>
        Math.max(0, otherLow - high, low - otherHigh);
    return Math.hypot(gap(a.min.x, a.max.x, b.min.x, b.max.x), gap(a.min.y, a.max.y, b.min.y, b.max.y),
                      gap(a.min.z, a.max.z, b.min.z, b.max.z));
}
