// SPDX-License-Identifier: Apache-2.0
// What the checks of a file share.
import {elementError, sectionError} from './error.js';

/** No coefficient of light is larger: irradiance in every direction is finite then. */
export const kLargestCoefficient = 1e37;

export function checkCount(section: string, count: number, expected: number, isOptional = true): void {
    if (count === expected || (isOptional && count === 0)) return;
    throw sectionError(section, `${count} elements instead of ${expected}`);
}

/** Throws for the first element of `size` values of which one is not good. */
export function checkEach(section: string, values: ArrayLike<number>, size: number, what: string,
                          isGood: (value: number) => boolean): void {
    for (let i = 0; i < values.length; ++i) {
        if (!isGood(values[i])) throw elementError(section, Math.floor(i / size), what);
    }
}

const square = (v: ArrayLike<number>) => v[0] * v[0] + v[1] * v[1] + v[2] * v[2];

export const isUnit = (v: ArrayLike<number>, tolerance: number) => Math.abs(square(v) - 1) < tolerance;

/** Of normal floats below 1e38. */
export function isPowerOfTwo(scale: number): boolean {
    return scale > 0 && scale < 1e38 && Number.isInteger(Math.log2(scale)) && 2 ** Math.log2(scale) === scale;
}
