// SPDX-License-Identifier: Apache-2.0
import {irradiance, kCoefficients} from 'tetralight';
import * as three from 'three';
import {expect, test} from 'vitest';

import {ProbeBalls} from '../../src/light/probe_balls';

test('very many probes are points, each in its mean light', () => {
    const count = 20_001;
    const balls = new ProbeBalls(new Float32Array(3 * count), 1);
    expect(balls.mesh).toBeInstanceOf(three.Points);
    const sh = new Float32Array(kCoefficients * count);
    const last = kCoefficients * (count - 1);
    for (let i = 0; i < kCoefficients; ++i) sh[last + i] = 1 + i;
    balls.setLight(sh);
    const {array} = balls.mesh.geometry.getAttribute('light');
    // Opposite directions cancel all but the constant and the quadratic terms, and three axes cancel the latter.
    const axes = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
    for (let channel = 0; channel < 3; ++channel) {
        const mean = axes.reduce((sum, axis) => sum + irradiance(sh, axis, last)[channel], 0) / 6;
        expect(array[3 * (count - 1) + channel]).toBeCloseTo(mean / Math.PI, 5);
    }
    expect(array[0]).toBe(0);
});

test('fewer are balls', () => {
    expect(new ProbeBalls(new Float32Array(3 * 20_000), 1).mesh).not.toBeInstanceOf(three.Points);
});
