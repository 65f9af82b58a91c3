// SPDX-License-Identifier: Apache-2.0
// Irradiance in spherical harmonics: 27 floats a probe (nine RGB coefficients), packed for shaders into
// seven vec4. The twin of probes/packed_sh.cpp.

export const kCoefficients = 27;
export const kPacked = 28;

/** K_i / π: the basis constant of each polynomial, over Lambert's π. */
const kScale = [0.08979356, 0.15552701, 0.15552701, 0.15552701, 0.34776897, 0.34776897, 0.10039225,
                0.34776897, 0.17388448];

export type Floats = Float32Array | number[];

/** Packs the 27 floats at `from` into the 28 at `to`. */
export function packSh(sh: Floats, from: number, packed: Floats, to: number): void {
    for (let channel = 0; channel < 3; ++channel) {
        const s = (i: number) => sh[from + 3 * i + channel] * kScale[i];
        const a = to + 4 * channel;
        packed[a] = s(3);
        packed[a + 1] = s(1);
        packed[a + 2] = s(2);
        packed[a + 3] = s(0) - s(6);
        packed[a + 12] = s(4);
        packed[a + 13] = s(5);
        packed[a + 14] = 3 * s(6);
        packed[a + 15] = s(7);
        packed[to + 24 + channel] = s(8);
    }
    packed[to + 27] = 1;
}

/** Irradiance / π at a unit normal: times albedo it is what a surface shows. */
export function samplePacked(packed: Floats, at: number, n: readonly number[]): number[] {
    const products = [n[0] * n[1], n[1] * n[2], n[2] * n[2], n[2] * n[0]];
    return [0, 1, 2].map(channel => {
        const a = at + 4 * channel;
        let sum = packed[a + 3] + packed[at + 24 + channel] * (n[0] * n[0] - n[1] * n[1]);
        for (let i = 0; i < 3; ++i) sum += packed[a + i] * n[i];
        for (let i = 0; i < 4; ++i) sum += packed[a + 12 + i] * products[i];
        return sum;
    });
}
