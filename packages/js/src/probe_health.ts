// SPDX-License-Identifier: Apache-2.0
// How far the light of each probe can be trusted (docs/file_format.md, section `health`).
import {kHealthSize, VolumeData} from './volume_data.js';

export interface ProbeHealth {
    /** Relative standard error of its light. */
    error: number;
    /** Distance to the nearest surface, metres; may be infinite. */
    surface: number;
    /** From the probe to where its light was captured, metres. */
    offset: readonly [number, number, number];
    /** Its light was interpolated from valid probes. */
    isDilated: boolean;
}

export function readHealth({health}: VolumeData): ProbeHealth[] {
    return Array.from({length: health.byteLength / kHealthSize}, (_, i) => {
        const number = (offset: number) => health.getFloat32(i * kHealthSize + offset, true);
        return {
            error: number(0), surface: number(4), offset: [number(8), number(12), number(16)],
            isDilated: health.getUint32(i * kHealthSize + 20, true) !== 0,
        };
    });
}
