// SPDX-License-Identifier: Apache-2.0
// On a slow machine, pictures that follow each other are coarse, and a full one follows once nothing changes.

const kSmooth = 20;  // milliseconds of a picture that keeps up with a hand
const kScales = [0.85, 0.7, 0.5, 0.35, 0.25];
/** The time of a full picture, which is antialiased, by that of one of its size that is not, as coarse ones are. */
const kAntialiasing = 1.5;

export class Pace {
    /** Milliseconds of a full picture; before the first, it is taken for slow. */
    private full = 8 * kSmooth;

    /** The resolution of the next picture along an axis, as a part of the full one. */
    get scale(): number {
        if (this.full <= kSmooth) return 1;
        const wanted = Math.sqrt(kAntialiasing * kSmooth / this.full);
        return kScales.find(scale => scale <= wanted) ?? kScales.at(-1)!;
    }

    /** A picture of a scale took so long. */
    took(milliseconds: number, scale: number): void {
        this.full = scale === 1 ? milliseconds : milliseconds * kAntialiasing / scale ** 2;
    }
}
