// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {Pace} from '../../src/view/pace';

test('the first picture is coarse, and those of a fast machine are full', () => {
    const pace = new Pace();
    expect(pace.scale).toBeLessThan(1);
    pace.took(5, 1);
    expect(pace.scale).toBe(1);
});

test('a picture without antialiasing, which takes half as long again, has half the resolution if a full one takes six times as long', () => {
    const pace = new Pace();
    pace.took(120, 1);
    expect(pace.scale).toBe(0.5);
    pace.took(20, 0.5);  // the same machine
    expect(pace.scale).toBe(0.5);
});

test('a machine that is nearly fast enough does not change to and fro', () => {
    const pace = new Pace();
    for (const full of [21, 25, 30, 35, 40]) {
        pace.took(full, 1);
        const {scale} = pace;
        expect(scale).toBe(0.85);
        pace.took(full / 1.5 * scale ** 2, scale);
        expect(pace.scale).toBe(scale);
    }
});

test('no picture is coarser than a quarter', () => {
    const pace = new Pace();
    pace.took(10_000, 1);
    expect(pace.scale).toBe(0.25);
});
