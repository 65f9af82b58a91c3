// SPDX-License-Identifier: Apache-2.0
// Scale and bias of F0 in the reflectance of GGX surfaces. The twin of reflection/split_sum.cpp, which cites
// the formulas.

export const kTableSize = 32;
const kSmallestAlpha = 1e-4;

/** Van der Corput's sequence. */
function reversedBits(index: number): number {
    let result = 0;
    for (let place = 0.5; index > 0; index >>>= 1, place /= 2) if (index & 1) result += place;
    return result;
}

/** A visible normal of facets: its z and its cosine to the direction of view, which has no y. */
function visibleNormal(viewX: number, viewZ: number, alpha: number, u: number, v: number): {z: number; vDotH: number} {
    const length = Math.hypot(alpha * viewX, viewZ);
    const [x, z] = [alpha * viewX / length, viewZ / length];
    const [radius, angle] = [Math.sqrt(u), 2 * Math.PI * v];
    const a = radius * Math.cos(angle);
    const shared = 0.5 * (1 + z);
    const b = (1 - shared) * Math.sqrt(1 - a * a) + shared * radius * Math.sin(angle);
    const c = Math.sqrt(Math.max(0, 1 - a * a - b * b));
    // side = (0, 1, 0), up = stretched × side = (-z, 0, x)
    const normal = [alpha * (c * x - b * z), alpha * a, Math.max(1e-12, b * x + c * z)];
    const size = Math.hypot(...normal);
    return {z: normal[2] / size, vDotH: Math.min(1, Math.max(0, (viewX * normal[0] + viewZ * normal[2]) / size))};
}

/** G2 / G1 of height-correlated Smith masking. */
function maskingRatio(nDotV: number, nDotL: number, alpha: number): number {
    const square = alpha * alpha;
    const v = Math.sqrt(nDotV * nDotV * (1 - square) + square);
    const l = Math.sqrt(nDotL * nDotL * (1 - square) + square);
    return nDotL * (nDotV + v) / (nDotL * v + nDotV * l);
}

/** Scale and bias for n · v and roughness in [0, 1]. */
export function integrateSplitSum(nDotV: number, roughness: number, sampleCount: number): [number, number] {
    const alpha = Math.max(roughness * roughness, kSmallestAlpha);
    const viewX = Math.sqrt(1 - nDotV * nDotV);
    let [scale, bias] = [0, 0];
    for (let i = 0; i < sampleCount; ++i) {
        const {z, vDotH} = visibleNormal(viewX, nDotV, alpha, (i + 0.5) / sampleCount, reversedBits(i));
        const nDotL = 2 * vDotH * z - nDotV;
        if (nDotL <= 0) continue;
        const seen = maskingRatio(nDotV, nDotL, alpha);
        const fresnel = (1 - vDotH) ** 5;
        scale += seen * (1 - fresnel);
        bias += seen * fresnel;
    }
    return [scale / sampleCount, bias / sampleCount];
}

/** Pairs at the centers of texels: n · v along a row, roughness from row to row. */
export function splitSumTable(size = kTableSize, sampleCount = 256): Float32Array {
    const table = new Float32Array(2 * size * size);
    for (let y = 0; y < size; ++y) {
        for (let x = 0; x < size; ++x) {
            table.set(integrateSplitSum((x + 0.5) / size, (y + 0.5) / size, sampleCount), 2 * (y * size + x));
        }
    }
    return table;
}
