// SPDX-License-Identifier: Apache-2.0
// The twin of `automatic_exposure` of pipeline/image_renderer.h.

/** 0.18 over the geometric mean of the luminance of RGBA pixels that are not black. */
export function middleGreyExposure(pixels: ArrayLike<number>): number {
    let sum = 0;
    let count = 0;
    for (let i = 0; i < pixels.length; i += 4) {
        const luminance = 0.2126 * pixels[i] + 0.7152 * pixels[i + 1] + 0.0722 * pixels[i + 2];
        if (!(luminance > 0)) continue;
        sum += Math.log(luminance);
        ++count;
    }
    return count === 0 ? 1 : 0.18 / Math.exp(sum / count);
}
