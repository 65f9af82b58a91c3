// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {kCoefficients, kPacked, packSh, samplePacked} from '../src/sh';
import {random, randomNormal} from './random';

/** The basis of docs/conventions.md. */
function basis([x, y, z]: number[]): number[] {
    return [0.282095, 0.488603 * y, 0.488603 * z, 0.488603 * x, 1.092548 * x * y, 1.092548 * y * z,
            0.315392 * (3 * z * z - 1), 1.092548 * x * z, 0.546274 * (x * x - y * y)];
}

test('constant radiance 1 shows 1 at every normal', () => {
    const sh = new Array<number>(kCoefficients).fill(0);
    sh.fill(Math.PI * Math.sqrt(4 * Math.PI), 0, 3);
    const packed = new Array<number>(kPacked).fill(0);
    packSh(sh, 0, packed, 0);
    const draw = random(1);
    for (let i = 0; i < 20; ++i) {
        for (const value of samplePacked(packed, 0, randomNormal(draw))) expect(value).toBeCloseTo(1, 5);
    }
});

test('packed light is the sum over the basis, over π', () => {
    const draw = random(2);
    for (let i = 0; i < 50; ++i) {
        const sh = Array.from({length: 2 * kCoefficients}, () => 2 * draw() - 1);
        const packed = new Float32Array(3 * kPacked);
        packSh(sh, kCoefficients, packed, 2 * kPacked);
        const normal = randomNormal(draw);
        const y = basis(normal);
        const shown = samplePacked(packed, 2 * kPacked, normal);
        for (let channel = 0; channel < 3; ++channel) {
            const sum = y.reduce((s, value, k) => s + value * sh[kCoefficients + 3 * k + channel], 0);
            expect(shown[channel]).toBeCloseTo(sum / Math.PI, 5);
        }
    }
});
