// SPDX-License-Identifier: Apache-2.0
// On a slow machine, pictures that follow each other are coarse, and a full one follows once nothing changes.

const kSmooth = 20;  // milliseconds of a picture that keeps up with a hand
const kScales = [1, 0.7, 0.5, 0.35, 0.25];

export class Pace {
    /** Milliseconds of a full picture; before the first, it is taken for slow. */
    private full = 8 * kSmooth;

    /** The resolution of the next picture along an axis, as a part of the full one. */
    get scale(): number {
        const wanted = Math.sqrt(kSmooth / this.full);
        return kScales.find(scale => scale <= wanted) ?? kScales.at(-1)!;
    }

    /** A picture of a scale took so long. */
    took(milliseconds: number, scale: number): void {
        this.full = milliseconds / scale ** 2;
    }
}
