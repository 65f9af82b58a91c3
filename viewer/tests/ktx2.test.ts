// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {parseLppv} from '../src/ktx2';

/** A file of 7 × 1 × 1 half texels, as bake/image/write_ktx2.cpp lays it out. */
function fileOf(constants: string): ArrayBuffer {
    const words = new TextEncoder().encode(`tetralight\0${constants}\0`);
    const begin = 104 + 4 + Math.ceil(words.length / 4) * 4;
    const bytes = new ArrayBuffer(begin + 56);
    const view = new DataView(bytes);
    [0x58544bab, 0xbb303220, 0x0a1a0a0d, 97, 2, 7, 1, 1, 0, 1, 1, 0].forEach(
        (word, i) => view.setUint32(4 * i, word, true));
    view.setUint32(56, 104, true);
    view.setUint32(60, 4 + Math.ceil(words.length / 4) * 4, true);
    view.setBigUint64(80, BigInt(begin), true);
    view.setBigUint64(88, 56n, true);
    view.setUint32(104, words.length, true);
    new Uint8Array(bytes).set(words, 108);
    view.setUint16(begin + 8, 0x3c00, true);  // 1.0
    return bytes;
}

const kConstants = JSON.stringify({
    local_from_world: Array.from({length: 16}, (_, i) => i), params: [1, 0, 0.25, 0], low: [1, 2, 3, 0],
    size_inverse: [4, 5, 6, 0], shb_r: [0, 0, 0, 0], shb_g: [0, 0, 0, 0], shb_b: [0, 0, 0, 0], shc: [7, 0, 0, 0],
});

test('texels and constants are read', () => {
    const {texture, constants} = parseLppv(fileOf(kConstants));
    expect(texture.image).toMatchObject({width: 7, height: 1, depth: 1});
    expect((texture.image.data as unknown as Uint16Array)[4]).toBe(0x3c00);
    expect(constants.low.toArray()).toEqual([1, 2, 3, 0]);
    expect(constants.local_from_world.elements[12]).toBe(12);
    expect(constants.shc.x).toBe(7);
});

test('other files are refused', () => {
    expect(() => parseLppv(new ArrayBuffer(200))).toThrow('not a KTX 2.0 file');
    const other = fileOf(kConstants);
    new DataView(other).setUint32(12, 37, true);
    expect(() => parseLppv(other)).toThrow('format 37');
});
