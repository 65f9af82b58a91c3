// SPDX-License-Identifier: Apache-2.0
import {irradiance, kCoefficients, kPacked, packSh, Volume} from 'tetralight';
import {expect, test} from 'vitest';

import {ambientOf, constantAnswers} from '../../src/light/answers';

test('the ambient color is the mean of the probes over all directions', () => {
    const probes = new Float32Array(2 * kCoefficients).fill(9);
    probes.set([1, 2, 3], 0);
    probes.set([3, 6, 9], kCoefficients);
    const sh = ambientOf({irradiance: probes, probeCount: 2} as Volume);
    const up = irradiance(sh, [0, 1, 0]);
    expect(irradiance(sh, [0.6, 0, -0.8])).toEqual(up);
    [2, 4, 6].forEach((mean, i) => expect(up[i]).toBeCloseTo(mean * 0.5 / Math.sqrt(Math.PI), 5));
});

test('constant answers are the same everywhere, also in a batch', () => {
    const sh = Float32Array.from({length: kCoefficients}, (_, i) => i);
    const expected = new Float32Array(kPacked);
    packSh(sh, 0, expected, 0);
    const packed = new Float32Array(2 * kPacked);
    constantAnswers(sh).batch([0, 0, 0, 5, 6, 7], {packed});
    expect(packed.subarray(0, kPacked)).toEqual(expected);
    expect(packed.subarray(kPacked)).toEqual(expected);
    expect(constantAnswers(sh).light([1, 2, 3]).sh).toBe(sh);
});
