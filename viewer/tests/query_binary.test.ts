// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {decodeAnswer, encodeQuery, WantedSh} from '../src/query_binary';

test('a question has a header of 16 bytes and three floats a position', () => {
    const view = new DataView(encodeQuery(new Float32Array([1, 2, 3, 4, 5, 6]), WantedSh.Packed));
    expect(view.byteLength).toBe(16 + 24);
    expect(view.getUint32(0, true)).toBe(0x31514c54);
    expect([view.getUint32(4, true), view.getUint8(8), view.getUint8(9)]).toEqual([2, 2, 2]);
    expect(view.getFloat32(16 + 20, true)).toBe(6);
});

function answerOf(count: number, sh: WantedSh): ArrayBuffer {
    const bytes = new ArrayBuffer(16 + count * (sh === WantedSh.Packed ? 112 : 0) + count * 24);
    const view = new DataView(bytes);
    view.setUint32(0, 0x31414c54, true);
    view.setUint32(4, count, true);
    view.setUint8(8, sh);
    let at = 16;
    for (let i = 0; i < count * (sh === WantedSh.Packed ? 28 : 0); ++i, at += 4) view.setFloat32(at, i, true);
    for (let i = 0; i < count; ++i, at += 24) {
        view.setUint32(at, 100 + i, true);
        [0.5, 1, 2, 3, 4].forEach((value, k) => view.setFloat32(at + 4 + 4 * k, value + 10 * i, true));
    }
    return bytes;
}

test('an answer gives light, cells, shares and weights', () => {
    const {sh, locations} = decodeAnswer(answerOf(2, WantedSh.Packed));
    expect(sh).toHaveLength(56);
    expect(sh[55]).toBe(55);
    expect([...locations.cells]).toEqual([100, 101]);
    expect([...locations.ambient]).toEqual([0.5, 10.5]);
    expect([...locations.weights]).toEqual([1, 2, 3, 4, 11, 12, 13, 14]);
});

test('an answer without light is cells alone', () => {
    const {sh, locations} = decodeAnswer(answerOf(3, WantedSh.None));
    expect(sh).toHaveLength(0);
    expect(locations.cells[2]).toBe(102);
});

test('every truncated answer is refused', () => {
    const whole = answerOf(2, WantedSh.Packed);
    for (let length = 0; length < whole.byteLength; ++length) {
        expect(() => decodeAnswer(whole.slice(0, length))).toThrow();
    }
});
