// SPDX-License-Identifier: Apache-2.0
// The light of many as a texture: seven texels each, in one row, whose 28 floats are those of `packSh`.
import * as three from 'three';

import {kPacked} from '../sh.js';

/** A row of the texture has at most 7 · 512 texels. */
const kInRow = 512;

/** One upload of everything is faster than more parts than these. */
const kMostParts = 256;

export class PackedTexture {
    readonly texture = new three.DataTexture(null, 1, 1, three.RGBAFormat, three.FloatType);
    private floats = new Float32Array(0);
    /** Whether everything waits for the next picture. */
    private isWhole = true;

    constructor() {
        this.texture.onUpdate = () => {
            this.isWhole = false;
            this.texture.clearUpdateRanges();  // WebGPURenderer does not
        };
    }

    /** Makes room for `count`; all light is gone. */
    resize(count: number): void {
        const columns = Math.max(1, Math.min(count, kInRow));
        const rows = Math.max(1, Math.ceil(count / columns));
        this.floats = new Float32Array(kPacked * columns * rows);
        this.texture.dispose();
        this.texture.image = {data: this.floats, width: 7 * columns, height: rows};
        this.uploadAll();
    }

    /** Copies the light of one from 28 floats. */
    set(i: number, packed: Float32Array, from: number): void {
        const {floats} = this;
        const to = kPacked * i;
        for (let k = 0; k < kPacked; ++k) floats[to + k] = packed[from + k];
    }

    /** Uploads the first `count` of those that are listed in ascending order. */
    upload(listed: Uint32Array, count: number): void {
        const {texture} = this;
        texture.needsUpdate = true;
        if (this.isWhole) return;
        for (let begin = 0; begin < count;) {
            let end = begin + 1;
            while (end < count && listed[end] === listed[end - 1] + 1 && listed[end] % kInRow !== 0) ++end;
            if (texture.updateRanges.length === kMostParts) {
                this.uploadAll();
                return;
            }
            texture.addUpdateRange(kPacked * listed[begin], kPacked * (end - begin));
            begin = end;
        }
    }

    uploadAll(): void {
        this.isWhole = true;
        this.texture.clearUpdateRanges();
        this.texture.needsUpdate = true;
    }
}
