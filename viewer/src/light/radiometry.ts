// SPDX-License-Identifier: Apache-2.0

/** The constant basis function Y₀ of spherical harmonics. */
export const kY0 = 0.5 / Math.sqrt(Math.PI);

/** Of linear RGB with the primaries of Rec. 709 that begins at `at`. */
export const luminance = (rgb: ArrayLike<number>, at = 0) => 0.2126 * rgb[at] + 0.7152 * rgb[at + 1] + 0.0722 * rgb[at + 2];
