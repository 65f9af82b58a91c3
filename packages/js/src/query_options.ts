// SPDX-License-Identifier: Apache-2.0
import {argumentError} from './error.js';

/**
 * The light outside the hull of the probes: that of the hull carried outwards, that of the closest point of the hull, or
 * the latter, fading to the ambient light. Each is continuous across the hull.
 */
export type Outside = 'extrapolate' | 'clamp' | 'ambient';

/** What is lit, and how. */
export interface QueryOptions {
    /** The cell where the walk begins: that of a position near by, or of the same object in the last frame. */
    hint?: number;
    outside?: Outside;
    /** Of `outside: 'ambient'`: distance from the hull at which light has faded to ambient light, metres. 10 by default. */
    fadeDistance?: number;
    /** Whether walls of the scene hide probes behind them. 'hide' by default. */
    walls?: 'hide' | 'ignore';
    /** Bit i: the object is on rendering layer i. Probes on none of its layers do not light it if its cell has others. */
    renderingLayers?: number;
    /** The light of hidden probes fades over this distance behind a wall, metres, such as the radius of the object. */
    radius?: number;
    /** The unit normal of a surface that the position lies on: it is pushed off along it. */
    normal?: ArrayLike<number>;
    /** How far positions with a normal are pushed, as a share of the mean distance to the probes. 0.1 by default. */
    normalOffset?: number;
}

export const kAllRenderingLayers = 0xffffffff;

/** Options without their defaults. */
export interface QuerySettings {
    outside: Outside;
    fadeDistance: number;
    hidesProbes: boolean;
    renderingLayers: number;
    radius: number;
    normalOffset: number;
}

export function readSettings(options: QueryOptions): QuerySettings {
    const {outside = 'extrapolate', fadeDistance = 10, walls = 'hide', normalOffset = 0.1, radius = 0,
           renderingLayers = kAllRenderingLayers} = options;
    if (!['extrapolate', 'clamp', 'ambient'].includes(outside)) throw argumentError('outside', `is "${outside}"`);
    if (walls !== 'hide' && walls !== 'ignore') throw argumentError('walls', `is "${walls}"`);
    if (!(fadeDistance > 0 && fadeDistance < Infinity)) {
        throw argumentError('fadeDistance', `is ${fadeDistance}; it must be positive and finite`);
    }
    checkLength('radius', radius);
    checkLength('normalOffset', normalOffset);
    return {outside, fadeDistance, hidesProbes: walls === 'hide', renderingLayers: renderingLayers >>> 0, radius,
            normalOffset};
}

export function checkLength(name: string, length: number): void {
    if (!(length >= 0 && length < Infinity)) throw argumentError(name, `is ${length}; it must be finite and not negative`);
}
