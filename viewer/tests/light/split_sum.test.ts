// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {integrateSplitSum, splitSumTable} from '../../src/light/split_sum';

/** The integral of glTF's specular lobe (appendix B.3) over all directions of light; dl = 4 v·h dh. */
function quadrature(nDotV: number, roughness: number): number[] {
    const kSteps = 500;
    const square = roughness ** 4;
    const viewX = Math.sqrt(1 - nDotV * nDotV);
    let [scale, bias] = [0, 0];
    for (let i = 0; i < kSteps; ++i) {
        const theta = Math.PI / 2 * (i + 0.5) / kSteps;
        const hz = Math.cos(theta);
        const d = square / (Math.PI * (hz * hz * (square - 1) + 1) ** 2);
        for (let j = 0; j < kSteps; ++j) {
            const vDotH = viewX * Math.sin(theta) * Math.cos(Math.PI * (j + 0.5) / kSteps) + nDotV * hz;
            const lz = 2 * vDotH * hz - nDotV;
            if (vDotH <= 0 || lz <= 0) continue;
            const masked = lz * Math.sqrt(nDotV ** 2 * (1 - square) + square) + nDotV * Math.sqrt(lz ** 2 * (1 - square) + square);
            const solidAngle = Math.PI / 2 / kSteps * Math.sin(theta) * 2 * Math.PI / kSteps * 4 * vDotH;
            const lobe = d * 0.5 / masked * lz * solidAngle;
            const fresnel = (1 - vDotH) ** 5;
            scale += lobe * (1 - fresnel);
            bias += lobe * fresnel;
        }
    }
    return [scale, bias];
}

test.each([[0.1, 0.5], [0.4, 0.5], [1, 0.5], [0.1, 1], [0.4, 1], [1, 1]])(
    "it is the integral of glTF's specular lobe at n · v = %f, roughness %f", (nDotV, roughness) => {
        const expected = quadrature(nDotV, roughness);
        integrateSplitSum(nDotV, roughness, 4096).forEach((x, i) => expect(Math.abs(x - expected[i])).toBeLessThan(1e-3));
    });

test("of a mirror it is Fresnel's reflectance", () => {
    for (const nDotV of [0.1, 0.3, 0.7, 1]) {
        const [scale, bias] = integrateSplitSum(nDotV, 0, 64);
        expect(scale + bias).toBeCloseTo(1, 4);
        expect(bias).toBeCloseTo((1 - nDotV) ** 5, 3);
    }
});

test('a table has n · v along a row, and roughness from row to row', () => {
    const table = splitSumTable(4, 64);
    expect([...table.slice(2 * (4 * 1 + 3), 2 * (4 * 1 + 4))]).toEqual(
        integrateSplitSum(0.875, 0.375, 64).map(Math.fround));
});
