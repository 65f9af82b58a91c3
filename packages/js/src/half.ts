// SPDX-License-Identifier: Apache-2.0
// IEEE 754 binary16.

const kInfinity = 0x7c00;

/** The value of a half. Not for infinities and NaNs. */
export function floatOfHalf(half: number): number {
    const exponent = half >> 10 & 31;
    const fraction = half & 1023;
    const size = exponent === 0 ? fraction * 2 ** -24 : (1024 + fraction) * 2 ** (exponent - 25);
    return half & 0x8000 ? -size : size;
}

export const isFiniteHalf = (half: number) => (half & kInfinity) !== kInfinity;

/** Finite, and at least 0. */
export const isLightHalf = (half: number) => half < kInfinity || half === 0x8000;
