// SPDX-License-Identifier: Apache-2.0
// Which reflection probes a mesh can see.
import type {ReflectionProbe} from 'tetralight';
import * as three from 'three';

const kReach = 1.001;  // tetralight_box_reach

/** A probe without a box is used everywhere. */
export const hasBox = ({halfSize}: ReflectionProbe) => Number.isFinite(halfSize[0]);

/** The order in which probes cover each other: importance, then small boxes first, then their order in the file.
 * The twin of `reflection_order` of reflection/sample_reflections.h. */
export function reflectionOrder(probes: ReflectionProbe[]): number[] {
    const volumes = probes.map(({halfSize: [x, y, z]}) => x * y * z);
    const compare = (a: number, b: number) => a < b ? -1 : Number(a > b);  // of infinities, too
    return probes.map((_, i) => i).sort((a, b) =>
        probes[b].importance - probes[a].importance || compare(volumes[a], volumes[b]) || a - b);
}

/** The `count` probes that surfaces in a world box see the most likely, in the order in which they cover each other:
 * those that are everywhere, then those with the nearest boxes. */
export function probesNear(probes: ReflectionProbe[], box: three.Box3, count: number): number[] {
    const order = reflectionOrder(probes);
    const distances = probes.map(probe => hasBox(probe) ? distanceBetween(worldBoxOf(probe), box) : -1);
    const near = new Set([...order].sort((a, b) => distances[a] - distances[b]).slice(0, count));
    return order.filter(probe => near.has(probe));
}

/** The world axes' box around where a probe counts. */
function worldBoxOf({position, boxCenter, halfSize, axes, blendDistance}: ReflectionProbe): three.Box3 {
    const half = new three.Vector3().setScalar(blendDistance);
    for (let i = 0; i < 3; ++i) {
        const axis = new three.Vector3().fromArray(axes.map(Math.abs), 3 * i);
        half.addScaledVector(axis, kReach * halfSize[i]);
    }
    const middle = new three.Vector3().fromArray(position).add(new three.Vector3().fromArray(boxCenter));
    return new three.Box3(middle.clone().sub(half), middle.clone().add(half));
}

function distanceBetween(a: three.Box3, b: three.Box3): number {
    const gap = (low: number, high: number, otherLow: number, otherHigh: number) =>
        Math.max(0, otherLow - high, low - otherHigh);
    return Math.hypot(gap(a.min.x, a.max.x, b.min.x, b.max.x), gap(a.min.y, a.max.y, b.min.y, b.max.y),
                      gap(a.min.z, a.max.z, b.min.z, b.max.z));
}

export interface ReflectionWeight {
    probe: number;
    weight: number;
}

/** The probes that a place mirrors, at most three, whose weights sum to 1; none outside all boxes. The twin of
 * `tetralight_reflection_weights` of runtime/shaders/reflection.glsl. */
export function reflectionWeights(probes: ReflectionProbe[], place: readonly number[]): ReflectionWeight[] {
    let uncovered = 1;
    const shares = reflectionOrder(probes).map(probe => {
        const weight = Math.min(influenceOf(probes[probe], place), uncovered);
        uncovered -= weight;
        return {probe, weight};
    }).filter(({weight}) => weight > 0).sort((a, b) => b.weight - a.weight);
    const least = shares[3]?.weight ?? 0;
    const first = shares.slice(0, 3);
    const sum = first.reduce((total, {weight}) => total + weight - least, 0);
    return first.map(({probe, weight}) => ({probe, weight: sum > 0 ? (weight - least) / sum : 1 / 3}))
        .filter(({weight}) => weight > 0);
}

function influenceOf(probe: ReflectionProbe, place: readonly number[]): number {
    if (!hasBox(probe)) return 1;
    const {position, boxCenter, halfSize, axes, blendDistance} = probe;
    const from = place.map((x, i) => x - position[i] - boxCenter[i]);
    const beyond = halfSize.map((half, i) => Math.max(
        0, Math.abs(from[0] * axes[3 * i] + from[1] * axes[3 * i + 1] + from[2] * axes[3 * i + 2]) - kReach * half));
    const distance = Math.hypot(...beyond);
    if (distance === 0) return 1;
    if (!(distance < blendDistance)) return 0;
    const t = 1 - distance / blendDistance;
    return t * t * (3 - 2 * t);
}
