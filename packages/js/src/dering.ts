// SPDX-License-Identifier: Apache-2.0
// Light without ringing: bands 1 and 2 are scaled down until no irradiance is negative (Sloan 2017, "Deringing Spherical
// Harmonics"), or by a fixed window (Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks").
import {kBasis, kCoefficients} from './sh.js';

/** Factors of bands 1 and 2, by the number of the window: Hann, Lanczos. */
const kWindows = [[1, 1], [0.75, 0.25], [0.82699334, 0.41349667]];

/** More than what rounding to floats can take away. */
const kMargin = 1 - 2 ** -20;

/** Changes the 27 floats at `at`. Window 0: the mildest that is sufficient, of each channel. */
export function dering(sh: Float32Array, at: number, window: number): void {
    for (let channel = 0; channel < 3; ++channel) {
        const [band1, band2] = window === 0 ? mildest(sh, at + channel) : kWindows[window];
        for (let i = 1; i < 9; ++i) sh[at + 3 * i + channel] *= i < 4 ? band1 : band2;
    }
}

/** E(n) = mean + w · (E(n) − mean) is least where E is, and 0 there for w = mean / (mean − least). */
function mildest(sh: Float32Array, at: number): [number, number] {
    const c = Array.from({length: kCoefficients / 3}, (_, i) => kBasis[i] * sh[at + 3 * i]);
    const least = minimum(c);
    const factor = least >= 0 ? 1 : c[0] > 0 ? Math.fround(kMargin * c[0] / (c[0] - least)) : 0;
    return [factor, factor];
}

/** The least value of Σ c_i p_i over the unit sphere: of a quadratic form and a linear one. */
function minimum(c: readonly number[]): number {
    const {values, axes} = eigen([[c[8] - c[6], c[4] / 2, c[7] / 2], [c[4] / 2, -c[8] - c[6], c[5] / 2],
                                  [c[7] / 2, c[5] / 2, 2 * c[6]]]);
    const linear = [c[3] / 2, c[1] / 2, c[2] / 2];
    const slope = axes.map(axis => axis[0] * linear[0] + axis[1] * linear[1] + axis[2] * linear[2]);
    return c[0] + minimumOnSphere(values, slope);
}

/**
 * Minimum of xᵀ diag(curvature) x + 2 slopeᵀx over |x| = 1, by its dual, which has no gap (Moré & Sorensen 1983): the
 * largest λ − Σ slope² / (curvature − λ) of λ up to the least curvature.
 */
function minimumOnSphere(curvature: readonly number[], slope: readonly number[]): number {
    const sum = (lambda: number, power: number) => slope.reduce(
        (total, s, i) => s === 0 ? total : total + s * s / (curvature[i] - lambda) ** power, 0);
    const least = Math.min(...curvature);
    let low = least - Math.hypot(...slope);
    let high = least;
    if (!(low < least)) return least;  // the slope is lost in rounding
    for (let step = 0; step < 64; ++step) {
        const middle = (low + high) / 2;
        if (!(middle > low && middle < high)) break;
        if (sum(middle, 2) <= 1) low = middle;
        else high = middle;
    }
    return low - sum(low, 1);
}

/** Eigenvalues of a symmetric matrix, and their unit axes, by Jacobi's rotations. Changes the matrix. */
function eigen(m: number[][]): {values: number[], axes: number[][]} {
    const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    for (let sweep = 0; sweep < 12; ++sweep) {
        for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
            if (m[p][q] === 0) continue;
            const ratio = (m[q][q] - m[p][p]) / (2 * m[p][q]);
            const t = (ratio < 0 ? -1 : 1) / (Math.abs(ratio) + Math.sqrt(ratio * ratio + 1));
            const cos = 1 / Math.sqrt(t * t + 1), sin = t * cos;
            rotate(m[0], m[1], m[2], p, q, cos, sin);
            [m[p], m[q]] = turn(m[p], m[q], cos, sin);
            [axes[p], axes[q]] = turn(axes[p], axes[q], cos, sin);
        }
    }
    return {values: [m[0][0], m[1][1], m[2][2]], axes};
}

const turn = (a: readonly number[], b: readonly number[], cos: number, sin: number) =>
    [a.map((x, i) => cos * x - sin * b[i]), a.map((x, i) => sin * x + cos * b[i])];

/** Turns columns p and q of the rows of a matrix. */
function rotate(a: number[], b: number[], c: number[], p: number, q: number, cos: number, sin: number): void {
    for (const row of [a, b, c]) [row[p], row[q]] = [cos * row[p] - sin * row[q], sin * row[p] + cos * row[q]];
}
