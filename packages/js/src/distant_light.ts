// SPDX-License-Identifier: Apache-2.0
// Light from infinitely far away as spherical harmonics of order 3: 16 RGB coefficients, one band more than probes have,
// because a probe that sees only a part of the sky needs it.
import {argumentError} from './error.js';
import {checkVector, kBasis, Vector} from './sh.js';

/** Floats of a distant light: three channels of 16 coefficients. */
export const kDistantCoefficients = 48;

/** √(35/32π), √(105/4π), √(21/32π), √(7/16π) */
const kOuter = 0.5900435899266435, kProduct = 2.890611442640554, kInner = 0.4570457994644658, kZonal = 0.3731763325901154;

/** The basis functions of bands 0 to 3 at a unit direction. */
function distantBasis([x, y, z]: readonly number[]): number[] {
    const polynomials = [1, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y];
    return [
        ...polynomials.map((polynomial, i) => kBasis[i] * polynomial),
        kOuter * y * (3 * x * x - y * y), kProduct * x * y * z, kInner * y * (5 * z * z - 1), kZonal * z * (5 * z * z - 3),
        kInner * x * (5 * z * z - 1), kProduct / 2 * z * (x * x - y * y), kOuter * x * (x * x - 3 * y * y),
    ];
}

/**
 * A sun that shines in `direction`, of any length but 0, with `irradiance`, RGB, on a surface that faces it.
 */
export function distantSun(direction: Vector, irradiance: Vector): Float32Array {
    const light = new Float32Array(kDistantCoefficients);
    const toLight = unit(direction).map(c => -c);
    distantBasis(toLight).forEach((basis, i) => {
        for (let channel = 0; channel < 3; ++channel) light[3 * i + channel] = irradiance[channel] * basis;
    });
    return light;
}

/** The same radiance, RGB, from everywhere. */
export function constantSky(radiance: Vector): Float32Array {
    checkVector('radiance', radiance);
    const light = new Float32Array(kDistantCoefficients);
    for (let channel = 0; channel < 3; ++channel) light[channel] = radiance[channel] * Math.sqrt(4 * Math.PI);
    return light;
}

export function unit(vector: Vector): [number, number, number] {
    checkVector('direction', vector);
    const length = Math.hypot(vector[0], vector[1], vector[2]);
    if (!(length > 0 && length < Infinity)) throw argumentError('direction', `is (${Array.from(vector).join(', ')})`);
    return [vector[0] / length, vector[1] / length, vector[2] / length];
}
