// SPDX-License-Identifier: Apache-2.0
// Irradiance as engines take it: coefficients of the polynomials themselves, divided by π.
import {kBasis, kCoefficients, Vector} from './sh.js';

/**
 * 27 floats c_i = K_i E_i / π in our order: Σ c_i p_i(n) is the radiance of a white diffuse surface, with the polynomials
 * p = 1, y, z, x, xy, yz, 3z²−1, xz, x²−y².
 */
export function polynomialSh(sh: Vector): Float32Array {
    return Float32Array.from({length: kCoefficients}, (_, i) => sh[i] * kBasis[Math.floor(i / 3)] / Math.PI);
}

/** Changes the frame of coefficients, in place: those of polynomials that are odd in an axis change their sign. */
export function mirrorSh(sh: Float32Array, axis: 'x' | 'z'): void {
    for (const i of axis === 'x' ? [3, 4, 7] : [2, 5, 7]) {
        for (let channel = 0; channel < 3; ++channel) sh[3 * i + channel] *= -1;
    }
}

/**
 * Coefficients c' of polynomials with Σ c'_i p_i(R n) = Σ c_i p_i(n) for all unit normals n. R is a rotation, by rows.
 * The quadratic part is a symmetric matrix M, as n · M n; it turns to R M Rᵀ.
 */
export function turnPolynomialSh(sh: Vector, rotation: readonly number[]): Float32Array {
    const turned = Float32Array.from({length: kCoefficients}, (_, i) => sh[i]);
    const at = (matrix: readonly number[], row: number, column: number) => matrix[3 * row + column];
    for (let channel = 0; channel < 3; ++channel) {
        const c = (i: number) => sh[3 * i + channel];
        const set = (i: number, value: number) => { turned[3 * i + channel] = value; };
        const linear = [c(3), c(1), c(2)];
        [3, 1, 2].forEach((i, row) => set(i, linear.reduce((sum, value, k) => sum + at(rotation, row, k) * value, 0)));
        // The trace is that of 3z² − 1 = −x² − y² + 2z² on the unit sphere: zero.
        const [xy, yz, xz] = [c(4) / 2, c(5) / 2, c(7) / 2];
        const quadratic = [c(8) - c(6), xy, xz, xy, -c(8) - c(6), yz, xz, yz, 2 * c(6)];
        const m = conjugate(rotation, quadratic);
        set(4, 2 * at(m, 0, 1));
        set(5, 2 * at(m, 1, 2));
        set(7, 2 * at(m, 0, 2));
        set(6, at(m, 2, 2) / 2);
        set(8, (at(m, 0, 0) - at(m, 1, 1)) / 2);
    }
    return turned;
}

/** R M Rᵀ of 3 × 3 matrices, by rows. */
function conjugate(r: readonly number[], m: readonly number[]): number[] {
    const product = multiply(r, m);
    const transposed = [r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]];
    return multiply(product, transposed);
}

function multiply(a: readonly number[], b: readonly number[]): number[] {
    return Array.from({length: 9}, (_, i) => {
        const [row, column] = [Math.floor(i / 3), i % 3];
        return [0, 1, 2].reduce((sum, k) => sum + a[3 * row + k] * b[3 * k + column], 0);
    });
}
