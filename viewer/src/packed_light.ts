// SPDX-License-Identifier: Apache-2.0
import type {Locations} from './query_binary';
import {kCoefficients, kPacked, packSh} from './sh';
import {blend, Light, Volume} from './volume';

/** The light at all located places, blended here and packed for shaders: 28 floats a place. */
export function packedLight(volume: Volume, light: Light, places: Locations): Float32Array {
    const packed = new Float32Array(places.count * kPacked);
    const sh = new Float32Array(kCoefficients);
    for (let i = 0; i < places.count; ++i) {
        blend(volume, light, places, i, sh, 0);
        packSh(sh, 0, packed, i * kPacked);
    }
    return packed;
}
