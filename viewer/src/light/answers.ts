// SPDX-License-Identifier: Apache-2.0
// The light at a position: of a volume, of a volume whose walls are ignored, or the same everywhere.
import {kCoefficients, kNone, kPacked, Light, packSh, Volume} from 'tetralight';

export type Answers = Pick<Volume, 'batch' | 'light'>;

/** Plain barycentric weights: light shines through walls. */
export function plainAnswers(volume: Volume): Answers {
    return {
        batch: (positions, outputs, options) => volume.batch(positions, outputs, {...options, walls: 'ignore'}),
        light: (position, options) => volume.light(position, {...options, walls: 'ignore'}),
    };
}

/** The same light everywhere: 27 coefficients of irradiance. */
export function constantAnswers(sh: Float32Array): Answers {
    const packed = new Float32Array(kPacked);
    packSh(sh, 0, packed, 0);
    const light = (): Light => ({cell: kNone, probes: [], weights: [], ambient: 1, sh, occlusion: new Float32Array(4).fill(1)});
    return {
        light,
        batch: ({length}, outputs) => {
            for (let i = 0; i < length / 3; ++i) {
                outputs.packed?.set(packed, kPacked * i);
                outputs.sh?.set(sh, kCoefficients * i);
            }
        },
    };
}

export const kNoLight = new Float32Array(kCoefficients);

/** The mean irradiance of all probes over all directions, as one ambient color. */
export function ambientOf({irradiance: probes, probeCount}: Volume): Float32Array {
    const sh = new Float32Array(kCoefficients);
    for (let probe = 0; probe < probeCount; ++probe) {
        for (let channel = 0; channel < 3; ++channel) sh[channel] += probes[kCoefficients * probe + channel] / probeCount;
    }
    return sh;
}
