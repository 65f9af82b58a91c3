// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {Pace} from '../../src/view/pace';

test('the first picture is coarse, and those of a fast machine are full', () => {
    const pace = new Pace();
    expect(pace.scale).toBeLessThan(1);
    pace.took(5, 1);
    expect(pace.scale).toBe(1);
});

test('a picture of four times the time has half the resolution', () => {
    const pace = new Pace();
    pace.took(80, 1);
    expect(pace.scale).toBe(0.5);
    pace.took(20, 0.5);  // the same machine
    expect(pace.scale).toBe(0.5);
});

test('no picture is coarser than a quarter', () => {
    const pace = new Pace();
    pace.took(10_000, 1);
    expect(pace.scale).toBe(0.25);
});
