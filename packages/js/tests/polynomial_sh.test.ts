// SPDX-License-Identifier: Apache-2.0
import {describe, expect, test} from 'vitest';

import {irradiance, kCoefficients} from '../src/index.js';
import {mirrorSh, polynomialSh, turnPolynomialSh} from '../src/polynomial_sh.js';
import {makeRandom} from './random.js';

function sum(c: ArrayLike<number>, [x, y, z]: readonly number[]): number[] {
    const polynomials = [1, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y];
    return [0, 1, 2].map(channel => polynomials.reduce((total, p, i) => total + p * c[3 * i + channel], 0));
}

function makeUnit(random: () => number, length: number): number[] {
    const v = Array.from({length}, () => random() - 0.5);
    return v.map(x => x / Math.hypot(...v));
}

describe('coefficients of polynomials', () => {
    const random = makeRandom(70);
    const sh = Float32Array.from({length: kCoefficients}, () => random() - 0.5);
    const normals = Array.from({length: 50}, () => makeUnit(random, 3));

    test('give irradiance divided by π', () => {
        for (const normal of normals) {
            const wanted = irradiance(sh, normal);
            sum(polynomialSh(sh), normal).forEach((value, i) => expect(value).toBeCloseTo(wanted[i] / Math.PI, 6));
        }
    });

    test('give the same light to normals that turn with them', () => {
        for (const normal of normals) {
            const [a, b, c, d] = makeUnit(random, 4);
            const rotation = [
                a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c),
                2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b),
                2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d];
            const turned = [0, 1, 2].map(row => normal.reduce((total, x, k) => total + rotation[3 * row + k] * x, 0));
            const wanted = sum(sh, normal);
            sum(turnPolynomialSh(sh, rotation), turned).forEach((value, i) => expect(value).toBeCloseTo(wanted[i], 6));
        }
    });

    test.each(['x', 'z'] as const)('give the same light to normals that are mirrored as they are in %s', axis => {
        const mirrored = Float32Array.from(sh);
        mirrorSh(mirrored, axis);
        for (const [x, y, z] of normals) {
            const wanted = sum(sh, [x, y, z]);
            sum(mirrored, axis === 'x' ? [-x, y, z] : [x, y, -z])
                .forEach((value, i) => expect(value).toBeCloseTo(wanted[i], 6));
        }
    });
});
