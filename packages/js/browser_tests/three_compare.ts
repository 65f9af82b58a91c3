// SPDX-License-Identifier: Apache-2.0
// Pictures of three.js against the light of the volume.
import {expect} from 'vitest';

import type {LitSquares} from './three_browser.js';
import type {Kind} from './three_squares.js';

/**
 * What the specular layer of a rough dielectric leaves for the diffuse one, by the cosine of the view: 1 minus what its
 * microfacets (GGX, Smith, α = 1) reflect of light from all directions, once or often (Fdez-Agüera 2019, "A
 * Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting"). three.js darkens its standard material by it.
 */
export function diffuseShare(cosine: number): number {
    const kF0 = 0.04;
    const kSteps = 64;
    let scale = 0, bias = 0;
    for (let i = 0; i < kSteps; ++i) {
        const z = (i + 0.5) / kSteps;
        for (let k = 0; k < kSteps; ++k) {
            const x = Math.sqrt(1 - z * z) * Math.cos(2 * Math.PI * (k + 0.5) / kSteps);
            // The half vector halves the angle between both directions.
            const vDotH = Math.sqrt((1 + x * Math.sqrt(1 - cosine * cosine) + z * cosine) / 2);
            const lobe = 0.5 / (z + cosine) / Math.PI * z * (2 * Math.PI / kSteps ** 2);
            const fresnel = (1 - vDotH) ** 5;
            scale += lobe * (1 - fresnel);
            bias += lobe * fresnel;
        }
    }
    const once = kF0 * scale + bias;
    const lost = 1 - scale - bias;
    const mean = kF0 + (1 - kF0) / 21;
    return 1 - once - once * mean / (1 - lost * mean) * lost;
}

/** The colors of squares, one each, seen along their normals. */
export function compareSquares(lit: LitSquares, kind: Kind, colors: number[][]): void {
    const share = kind === 'standard' ? diffuseShare(1) : 1;
    const tolerance = (kind === 'standard' ? 2e-3 : 1e-3) * lit.brightest;  // three.js interpolates a table of shares
    expect(colors).toHaveLength(lit.squares.length);
    colors.forEach((color, i) => {
        const want = lit.radiance(lit.squares[i]);
        color.forEach((value, k) => {
            expect(Math.abs(value - share * want[k]), `square ${i}`).toBeLessThan(tolerance);
        });
    });
}

/** A linear number from 0 to 1 as the 8 bits of sRGB (IEC 61966-2-1). */
export function encode(linear: number): number {
    const value = Math.min(Math.max(linear, 0), 1);
    return 255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);
}

/** The pixels of a sphere at each place, seen along the normal of the square: normals and colors. */
export function compareSpheres(lit: LitSquares, kind: Kind, exposure: number, spheres: number[][][]): void {
    expect(spheres).toHaveLength(lit.squares.length);
    let largest = 0;
    let diffuse = 0;
    spheres.forEach((pixels, i) => {
        const {position, normal: view} = lit.squares[i];
        expect(pixels.length).toBeGreaterThan(600);
        for (const [x, y, z, ...color] of pixels) {
            const cosine = x * view[0] + y * view[1] + z * view[2];
            const share = kind === 'standard' ? shareOf(cosine) : 1;
            lit.radiance({position, normal: [x, y, z]}).forEach((value, k) => {
                largest = Math.max(largest, Math.abs(color[k] - encode(exposure * value * share)));
                diffuse = Math.max(diffuse, Math.abs(color[k] - encode(exposure * value)));
            });
        }
    });
    if (process.env.TETRALIGHT_PRINT) console.log(`spheres of ${kind}: ${largest} of 255; as diffuse ${diffuse}`);
    expect(largest).toBeLessThanOrEqual(2);
}

const shares = new Map<number, number>();

/** `diffuseShare`, once for each pixel of the picture. */
function shareOf(cosine: number): number {
    const key = Math.round(1e6 * cosine);
    const share = shares.get(key) ?? diffuseShare(cosine);
    shares.set(key, share);
    return share;
}
