// SPDX-License-Identifier: Apache-2.0
// The light of a volume at one place: the same at every pixel of an object but for its normal.
import {kPacked} from 'tetralight';

import type {Answers} from './answers';
import type {PlaceUniforms} from './shaders';

export class PlaceLight {
    readonly uniforms: PlaceUniforms = {placeSh: {value: new Float32Array(kPacked)}};
    private own = this.uniforms.placeSh.value;
    private point: Float32Array | null = null;
    /** Of the sides of a comparison at this place. */
    private readonly others = new Map<Answers, Float32Array>();

    place(volume: Answers, point: readonly number[]): void {
        this.others.clear();
        this.point = new Float32Array(point);
        this.own = this.uniforms.placeSh.value = this.lightOf(volume);
    }

    clear(): void {
        this.others.clear();
        this.point = null;
        this.own = this.uniforms.placeSh.value = new Float32Array(kPacked);
    }

    /** Shows another light, or that of its volume. */
    showLight(answers: Answers | null): void {
        if (answers !== null && this.point !== null && !this.others.has(answers)) this.others.set(answers, this.lightOf(answers));
        this.uniforms.placeSh.value = answers === null ? this.own : this.others.get(answers) ?? this.own;
    }

    private lightOf(volume: Answers): Float32Array {
        const packed = new Float32Array(kPacked);
        volume.batch(this.point!, {packed});
        return packed;
    }
}
