// SPDX-License-Identifier: Apache-2.0
import type {QueryOptions} from './query_options.js';
import {kNone} from './section_file.js';
import {kCoefficients, Vector} from './sh.js';
import type {Volume} from './volume.js';

/** Options of all queries of objects. */
export type ObjectOptions = Pick<QueryOptions, 'outside' | 'fadeDistance' | 'walls' | 'radius' | 'renderingLayers'>;

/** The light of an object that moves: it is found again when the position differs from that of before. */
export class MovingLight {
    /** 27 floats, as in `Light`. */
    sh: Float32Array = new Float32Array(kCoefficients);
    private readonly position = [NaN, NaN, NaN];
    private hint = kNone;

    /** Whether the light was found again. */
    moveTo(position: Vector, volume: Volume, options: ObjectOptions): boolean {
        if (this.position.every((x, axis) => x === position[axis])) return false;
        for (let axis = 0; axis < 3; ++axis) this.position[axis] = position[axis];
        const light = volume.light(position, {...options, hint: this.hint});
        this.hint = light.cell;
        this.sh = light.sh;
        return true;
    }

    /** The next move finds the light. */
    forget(): void {
        this.position.fill(NaN);
    }
}
