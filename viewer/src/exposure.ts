// SPDX-License-Identifier: Apache-2.0

/** 0.18 over the geometric mean of the luminance of RGBA pixels that are not black; the twin of
 * `automatic_exposure` of pipeline/image_renderer.h. */
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

/** The light that a picture shows: takes back sRGB (IEC 61966-2-1) and the tone mapping before it, Khronos PBR
 * Neutral at an exposure so small that nothing is compressed, from RGBA pixels, in place. */
export function takeToneMappingBack(pixels: Float32Array, exposure: number): void {
    const kDark = 0.08;  // of the least channel: below it, the toe begins
    const linear = (v: number) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
    for (let i = 0; i < pixels.length; i += 4) {
        const color = pixels.subarray(i, i + 3).map(linear);
        const least = Math.max(0, Math.min(...color));  // 6.25 x² in the toe, else x - 0.04
        const offset = least < kDark / 2 ? Math.sqrt(least / 6.25) - least : kDark / 2;
        pixels.set(color.map(v => (v + offset) / exposure), i);
    }
}
