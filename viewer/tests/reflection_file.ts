// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';

const kHeader = 104;

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

/** A file of cubes with one level for each of `sides`: each face has one color, `color(cube, face, level)`. */
export function reflectionFile(probes: ProbeSetup[], sides: number[], cubeCount: number,
                               color: (cube: number, face: number, level: number) => number[]): ArrayBuffer {
    const words = new TextEncoder().encode(`tetralight\0${JSON.stringify({probes})}\0`);
    const keys = kHeader + 24 * (sides.length - 1);
    const keyBytes = 4 + Math.ceil(words.length / 4) * 4;
    const lengths = sides.map(side => 8 * side * side * 6 * cubeCount);
    const begin = Math.ceil((keys + keyBytes) / 8) * 8;
    const bytes = new ArrayBuffer(begin + lengths.reduce((sum, length) => sum + length));
    const view = new DataView(bytes);
    [0x58544bab, 0xbb303220, 0x0a1a0a0d, 97, 2, sides[0], sides[0], 0, cubeCount, 6, sides.length, 0].forEach(
        (word, i) => view.setUint32(4 * i, word, true));
    view.setUint32(56, keys, true);
    view.setUint32(60, keyBytes, true);
    view.setUint32(keys, words.length, true);
    new Uint8Array(bytes).set(words, keys + 4);
    let at = begin;
    sides.forEach((side, level) => {
        view.setBigUint64(80 + 24 * level, BigInt(at), true);
        view.setBigUint64(88 + 24 * level, BigInt(lengths[level]), true);
        for (let texel = 0; texel < lengths[level] / 8; ++texel) {
            const face = Math.floor(texel / (side * side));
            [...color(Math.floor(face / 6), face % 6, level), 1].forEach(
                (x, c) => view.setUint16(at + 8 * texel + 2 * c, three.DataUtils.toHalfFloat(x), true));
        }
        at += lengths[level];
    });
    return bytes;
}
