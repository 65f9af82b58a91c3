// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {exposureOfProbes, meteredExposure, takeToneMappingBack} from '../../src/view/exposure';
import {random} from '../random';

const grey = (...values: number[]) => values.flatMap(value => [value, value, value, 1]);

test('an even view becomes middle grey', () => {
    expect(meteredExposure(grey(3, 3, 3))! * 3).toBeCloseTo(0.18, 6);
});

test('the geometric mean counts, and black pixels do not', () => {
    const view = grey(...Array<number>(50).fill(0.5), ...Array<number>(50).fill(1), 0);
    expect(meteredExposure(view)).toBeCloseTo(0.18 / Math.sqrt(0.5), 6);
    expect(meteredExposure(grey(0, 0))).toBeNull();
});

test('a tenth of the view that is brighter than white makes it darker, until it is white', () => {
    const view = grey(...Array<number>(90).fill(1), ...Array<number>(10).fill(8));
    expect(0.18 / 8 ** 0.1 * 8).toBeGreaterThan(1);
    expect(meteredExposure(view)! * 8).toBeCloseTo(1, 6);
});

test('a bright window darkens its room by two stops at most', () => {
    const view = grey(...Array<number>(90).fill(1), ...Array<number>(10).fill(1000));
    expect(meteredExposure(view)).toBeCloseTo(0.18 / 1000 ** 0.1 / 4, 6);
});

test('a few bright pixels do not count', () => {
    const view = grey(...Array<number>(97).fill(1), ...Array<number>(3).fill(100));
    expect(meteredExposure(view)).toBeCloseTo(0.18 / 100 ** 0.03, 6);
});

test('the light of probes gives a first exposure', () => {
    const probe = new Float32Array(27);
    probe.fill(Math.PI / (0.5 / Math.sqrt(Math.PI)), 0, 3);  // irradiance pi in every direction: radiance 1
    expect(exposureOfProbes(probe)! * 0.4).toBeCloseTo(0.18, 6);
    expect(exposureOfProbes(new Float32Array(27))).toBeNull();
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
