// SPDX-License-Identifier: Apache-2.0
// Irradiance as spherical harmonics: nine RGB coefficients E_i of the orthonormal basis 1, y, z, x, xy, yz, 3z²−1, xz,
// x²−y² (docs/conventions.md).
import {argumentError} from './error.js';

/** Floats of one probe: three channels of nine coefficients. */
export const kCoefficients = 27;

/** Floats of one probe as shaders read it: seven vec4. */
export const kPacked = 28;

/** The factor K_i of each polynomial: Y_i = K_i · p_i. */
export const kBasis = [0.28209479177387814, 0.48860251190291992, 0.48860251190291992, 0.48860251190291992,
                1.09254843059207907, 1.09254843059207907, 0.31539156525252001, 1.09254843059207907,
                0.54627421529603953];

/** Each coefficient of irradiance over that of radiance: the convolution with the cosine. */
export const kCosine = [0, 1, 1, 1, 2, 2, 2, 2, 2].map(band => [Math.PI, 2 * Math.PI / 3, Math.PI / 4][band]);

export type Vector = ArrayLike<number>;

/** Throws unless there are three numbers, which may be NaN or infinite. */
export function checkVector(name: string, vector: Vector): void {
    const isVector = vector?.length >= 3 && [0, 1, 2].every(i => typeof vector[i] === 'number');
    if (!isVector) throw argumentError(name, `is not three numbers: ${JSON.stringify(vector)}`);
}

/**
 * Irradiance, RGB, on a surface with a unit normal: E(n) = Σ E_i Y_i(n), not divided by π, in the units of the lights.
 * A diffuse surface reflects the radiance albedo / π · E. `sh` has 27 numbers from `from` on. The normal is not normalized here.
 */
export function irradiance(sh: Vector, normal: Vector, from = 0): [number, number, number] {
    const [x, y, z] = [normal[0], normal[1], normal[2]];
    const polynomials = [1, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y];
    const sum: [number, number, number] = [0, 0, 0];
    for (let i = 0; i < 9; ++i) {
        const basis = kBasis[i] * polynomials[i];
        for (let channel = 0; channel < 3; ++channel) sum[channel] += sh[from + 3 * i + channel] * basis;
    }
    return sum;
}

/**
 * Packs the 27 floats at `from` into the 28 at `to`: SHAr, SHAg, SHAb, SHBr, SHBg, SHBb, SHC, whose sum is irradiance / π:
 * dot(SHA, (n, 1)) + dot(SHB, (xy, yz, zz, zx)) + SHC · (x² − y²).
 */
export function packSh(sh: Vector, from: number, packed: Float32Array | number[], to: number): void {
    for (let channel = 0; channel < 3; ++channel) {
        const at = from + channel;
        const a = to + 4 * channel;
        const s6 = sh[at + 18] * (kBasis[6] / Math.PI);
        packed[a] = sh[at + 9] * (kBasis[3] / Math.PI);
        packed[a + 1] = sh[at + 3] * (kBasis[1] / Math.PI);
        packed[a + 2] = sh[at + 6] * (kBasis[2] / Math.PI);
        packed[a + 3] = sh[at] * (kBasis[0] / Math.PI) - s6;
        packed[a + 12] = sh[at + 12] * (kBasis[4] / Math.PI);
        packed[a + 13] = sh[at + 15] * (kBasis[5] / Math.PI);
        packed[a + 14] = 3 * s6;
        packed[a + 15] = sh[at + 21] * (kBasis[7] / Math.PI);
        packed[to + 24 + channel] = sh[at + 24] * (kBasis[8] / Math.PI);
    }
    packed[to + 27] = 1;
}
