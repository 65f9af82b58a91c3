// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {middleGreyExposure, takeToneMappingBack} from '../src/exposure';
import {random} from './random';

const grey = (...values: number[]) => values.flatMap(value => [value, value, value, 1]);

test('an even view becomes middle grey', () => {
    expect(middleGreyExposure(grey(3, 3, 3)) * 3).toBeCloseTo(0.18, 6);
});

test('the geometric mean counts, and black pixels do not', () => {
    expect(middleGreyExposure(grey(0.01, 1, 0))).toBeCloseTo(0.18 / 0.1, 6);
    expect(middleGreyExposure(grey(0, 0))).toBe(1);
});

/** What three.js draws: Khronos PBR Neutral by its specification, then sRGB. */
function drawn(light: number[], exposure: number): number[] {
    const exposed = light.map(v => v * exposure);
    const least = Math.min(...exposed);
    const offset = least < 0.08 ? least - 6.25 * least * least : 0.04;
    return exposed.map(v => v - offset).map(v => v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
}

test('the light of a picture is found under its tone mapping', () => {
    const draw = random(5);
    const exposure = 2 ** -12;
    const light = Array.from({length: 500}, () => [0, 1, 2].map(() => 10 ** (6 * draw() - 3)));
    const pixels = new Float32Array(light.flatMap(color => [...drawn(color, exposure), 1]));
    takeToneMappingBack(pixels, exposure);
    light.forEach((color, i) => color.forEach((v, c) => {
        expect(Math.abs(pixels[4 * i + c] / v - 1)).toBeLessThan(1e-3);
        expect(pixels[4 * i + 3]).toBe(1);
    }));
});
