// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {meanAndP95} from '../../src/compare/mean_p95';

test('mean and p95', () => {
    expect(meanAndP95(Array.from({length: 100}, (_, i) => i + 1))).toEqual([50.5, 95]);
});
