// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {placeOf, readPages, sectionsOf} from '../src/lightmaps';

test('nodes of unwrap and of export say the same place', () => {
    const scale = [0.5, 0.25], offset = [0.125, 0.5];
    const unwrapped = {extras: {lightmap_rectangle: {page: 1, texCoord: 2, scale, offset}}};
    const exported = {extensions: {MX_lightmap: {lightMapTexture: {index: 4, texCoord: 2}, scale, offset}}};
    expect(placeOf(unwrapped, -1)).toEqual({page: 1, channel: 2, scale, offset});
    expect(placeOf(exported, 3)).toEqual(placeOf(unwrapped, -1));
    expect(placeOf({extras: {}}, 0)).toBeNull();
});

/** A file of two sections: `info` of one page of 2 × 2 texels with the scale 4, and `irradiance`. */
function makeFile(): ArrayBuffer {
    const bytes = new ArrayBuffer(320);
    const view = new DataView(bytes);
    view.setUint32(12, 2, true);
    ['info', 'irradiance'].forEach((name, i) => {
        const entry = 64 + 64 * i;
        new Uint8Array(bytes, entry, name.length).set(new TextEncoder().encode(name));
        view.setBigUint64(entry + 24, BigInt(192 + 64 * i), true);
        view.setBigUint64(entry + 32, BigInt([1, 4][i]), true);
        view.setBigUint64(entry + 40, BigInt([64, 8][i]), true);
    });
    view.setUint32(192, 2, true);
    view.setUint32(196, 1, true);
    view.setFloat32(204, 4, true);
    for (let i = 0; i < 16; ++i) view.setUint16(256 + 2 * i, i, true);
    return bytes;
}

test('a file is read by its sections, and pages from two of them', () => {
    const sections = sectionsOf(makeFile());
    expect([...sections.keys()]).toEqual(['info', 'irradiance']);
    expect(sections.get('irradiance')!.byteLength).toBe(32);
    const {size, scale, pages} = readPages(sections.get('info')!, sections.get('irradiance')!);
    expect([size, scale, pages.length]).toEqual([2, 4, 1]);
    expect([...pages[0]]).toEqual(Array.from({length: 16}, (_, i) => i));
});
