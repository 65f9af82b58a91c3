// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {middleGreyExposure} from '../src/exposure';

const grey = (...values: number[]) => values.flatMap(value => [value, value, value, 1]);

test('an even view becomes middle grey', () => {
    expect(middleGreyExposure(grey(3, 3, 3)) * 3).toBeCloseTo(0.18, 6);
});

test('the geometric mean counts, and black pixels do not', () => {
    expect(middleGreyExposure(grey(0.01, 1, 0))).toBeCloseTo(0.18 / 0.1, 6);
    expect(middleGreyExposure(grey(0, 0))).toBe(1);
});
