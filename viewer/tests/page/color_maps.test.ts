// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {cssGradient, kDifferenceMap, kHeatMap, oklch, Rgb} from '../../src/page/color_maps';

const linear = (x: number) => x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
/** Relative luminance, which orders colors by lightness. */
const luminance = ([r, g, b]: Rgb) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
const steps = Array.from({length: 33}, (_, i) => i / 32);

test('without chroma a color is grey of this lightness: its luminance is the cube', () => {
    for (const lightness of [0.2, 0.5, 0.9]) {
        const [r, g, b] = oklch(lightness, 0, 0);
        expect(Math.max(r, g, b) - Math.min(r, g, b)).toBeLessThan(1e-3);
        expect(luminance([r, g, b])).toBeCloseTo(lightness ** 3, 3);
    }
});

test('more heat is lighter', () => {
    const light = steps.map(x => luminance(kHeatMap.color(x)));
    light.slice(1).forEach((value, i) => expect(value).toBeGreaterThan(light[i]));
});

test('larger differences are lighter, to both sides alike, and both sides differ in hue', () => {
    for (const sign of [-1, 1]) {
        const light = steps.map(x => luminance(kDifferenceMap.color(sign * x)));
        light.slice(1).forEach((value, i) => expect(value).toBeGreaterThan(light[i]));
    }
    const [low, high] = [-1, 1].map(x => kDifferenceMap.color(x));
    expect(luminance(low) / luminance(high)).toBeGreaterThan(0.8);
    expect(luminance(low) / luminance(high)).toBeLessThan(1.25);
    expect(low[2]).toBeGreaterThan(low[0] + 0.3);
    expect(high[0]).toBeGreaterThan(high[2] + 0.3);
});

test('a gradient has a color for each step', () => {
    expect(cssGradient(kHeatMap, 4).match(/rgb\(/g)).toHaveLength(5);
});
