// SPDX-License-Identifier: Apache-2.0
// The light of many as a texture: seven texels each, in one row, whose 28 floats are those of `packSh`.
import * as three from 'three';

import {kPacked} from '../sh.js';

/** A row of the texture has at most 7 · 512 texels. */
export const kInstancesInRow = 512;

export function makePackedTexture(): three.DataTexture {
    return new three.DataTexture(null, 1, 1, three.RGBAFormat, three.FloatType);
}

/** Makes room for `count`. Returns the floats of the texture; they go to the GPU when `needsUpdate` is set. */
export function resizePackedTexture(texture: three.DataTexture, count: number): Float32Array<ArrayBuffer> {
    const columns = Math.max(1, Math.min(count, kInstancesInRow));
    const rows = Math.max(1, Math.ceil(count / columns));
    const packed = new Float32Array(kPacked * columns * rows);
    texture.dispose();
    texture.image = {data: packed, width: 7 * columns, height: rows};
    return packed;
}
