// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {meanLight} from '../../src/inspect/light_swatch';

test('light of 1 from everywhere is 1 over π of irradiance π', () => {
    const sh = new Float32Array(27);
    sh.fill(Math.PI / 0.282095, 0, 3);  // E = π for every normal
    for (const channel of meanLight(sh)) expect(channel).toBeCloseTo(1, 5);
});
