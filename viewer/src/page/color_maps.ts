// SPDX-License-Identifier: Apache-2.0
// Color maps whose lightness follows the value: equal steps of a value look equally large, also without color.
// Oklab: B. Ottosson, "A perceptual color space for image processing", 2020.

/** Red, green and blue of sRGB, 0 to 1. */
export type Rgb = [number, number, number];
/** Of a value from `low` to `high`. */
export interface ColorMap {
    low: number;
    high: number;
    color: (value: number) => Rgb;
}

const kDegree = Math.PI / 180;

/** A color of Oklab, by lightness 0 to 1, chroma and hue. */
export function oklch(lightness: number, chroma: number, hueDegrees: number): Rgb {
    const a = chroma * Math.cos(hueDegrees * kDegree);
    const b = chroma * Math.sin(hueDegrees * kDegree);
    const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
    const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
    const s = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3;
    return [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s].map(encode) as Rgb;
}

function encode(linear: number): number {
    const x = Math.min(1, Math.max(0, linear));
    return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

/** -1 blue, 0 almost black, 1 orange: both ends are equally light. */
export const kDifferenceMap: ColorMap = {
    low: -1, high: 1,
    color: value => {
        const size = Math.min(1, Math.abs(value));
        return oklch(0.2 + 0.56 * size, 0.12 * Math.sqrt(size), value < 0 ? 245 : 58);
    },
};

/** From violet over red to pale yellow. */
export const kHeatMap: ColorMap = {
    low: 0, high: 1,
    color: value => {
        const x = Math.min(1, Math.max(0, value));
        return oklch(0.4 + 0.55 * x, 0.14 + 0.05 * Math.sin(Math.PI * x) - 0.04 * x, 305 + 160 * x);
    },
};

export const cssColor = (rgb: Rgb) => `rgb(${rgb.map(x => Math.round(255 * x)).join(' ')})`;

/** A gradient from left to right. */
export function cssGradient({low, high, color}: ColorMap, steps = 16): string {
    const stops = Array.from({length: steps + 1}, (_, i) => cssColor(color(low + (high - low) * i / steps)));
    return `linear-gradient(to right, ${stops.join(', ')})`;
}
