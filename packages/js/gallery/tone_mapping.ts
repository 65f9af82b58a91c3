// SPDX-License-Identifier: Apache-2.0
// The command `tetralight render` shows colors by the tone mapping Khronos PBR Neutral. Engines here have none, so the page
// undoes that of the command's pictures.

/** The brightest color that the tone mapping does not compress, after it. */
export const kUncompressed = 0.76;

const decode = (byte: number) => byte <= 0.04045 * 255 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4;
const encode = (value: number) => 255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);

/** In place: RGBA bytes of a picture without compressed colors. */
export function undoToneMapping(pixels: Uint8ClampedArray): void {
    for (let at = 0; at < pixels.length; at += 4) {
        const color = [0, 1, 2].map(i => decode(pixels[at + i]));
        // The tone mapping subtracts x − 6.25 x² if the least of three, x, is less than 0.08, or else 0.04.
        const least = Math.min(...color);
        const offset = least < 0.04 ? Math.sqrt(least / 6.25) - least : 0.04;
        color.forEach((value, i) => { pixels[at + i] = Math.round(encode(value + offset)); });
    }
}
