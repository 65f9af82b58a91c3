// SPDX-License-Identifier: Apache-2.0
// How bright a picture is shown (docs/viewer.md, "Exposure").
import {kY0, luminance} from '../light/radiometry';

const kMiddleGrey = 0.18;
const kWhiteShare = 0.95;   // of the pixels are exposed below white
const kMostDarkening = 2;   // stops, so that a window does not blacken its room
const kUsualAlbedo = 0.4;

const litOf = (pixels: ArrayLike<number>) =>
    Array.from({length: pixels.length / 4}, (_, i) => luminance(pixels, 4 * i)).filter(x => x > 0);

/** Brings the log-average luminance of RGBA pixels to middle grey (Reinhard et al. 2002, equation 1). Black pixels do not
 * count. */
export function middleGreyExposure(pixels: ArrayLike<number>): number {
    const lit = litOf(pixels);
    return lit.length === 0 ? 1 : kMiddleGrey / Math.exp(lit.reduce((sum, x) => sum + Math.log(x), 0) / lit.length);
}

/** Middle grey, but darker, by at most two stops, where more than a twentieth of the pixels that are not black would be
 * brighter than white. Null: all pixels are black. */
export function meteredExposure(pixels: ArrayLike<number>): number | null {
    const lit = litOf(pixels).sort((a, b) => a - b);
    if (lit.length === 0) return null;
    const grey = middleGreyExposure(pixels);
    const white = 1 / lit[Math.floor(kWhiteShare * (lit.length - 1))];
    return Math.min(grey, Math.max(white, grey / 2 ** kMostDarkening));
}

/** For the first picture, before it is metered: middle grey for surfaces of usual albedo in the mean light of the
 * probes. 27 coefficients of irradiance a probe; null: no probe is lit. */
export function exposureOfProbes(irradiance: ArrayLike<number>): number | null {
    let [sum, count] = [0, 0];
    for (let i = 0; i < irradiance.length; i += 27) {
        const reflected = kY0 * kUsualAlbedo / Math.PI * luminance(irradiance, i);
        if (!(reflected > 0)) continue;
        sum += Math.log(reflected);
        ++count;
    }
    return count === 0 ? null : kMiddleGrey / Math.exp(sum / count);
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
