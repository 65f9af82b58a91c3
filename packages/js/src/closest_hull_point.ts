// SPDX-License-Identifier: Apache-2.0
// The point of the hull that is closest to a position outside.
import {Dimension, kNone, VolumeData} from './volume_data.js';

type Vec3 = [number, number, number];

export interface HullPoint {
    cell: number;
    weights: Vec3;
    /** Metres. */
    distance: number;
}

const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a: Vec3, b: Vec3): Vec3 =>
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** The closest point of all faces of the hull, by descent from `hullCell`. */
export function closestHullPoint(volume: VolumeData, local: Float64Array, hullCell: number): HullPoint {
    return new Descent(volume, local).run(hullCell);
}

/** From face to face, each closer than the one before: the hull is convex. */
class Descent {
    private readonly cellCount: number;
    private readonly cornerCount: number;
    private best: HullPoint = {cell: kNone, weights: [0, 0, 0], distance: Infinity};

    constructor(private readonly volume: VolumeData, private readonly local: Float64Array) {
        this.cellCount = volume.cells.length / 8;
        this.cornerCount = volume.info.dimension - 1;
    }

    run(start: number): HullPoint {
        this.consider(start);
        for (let step = 0; step < this.cellCount; ++step) {
            const before = this.best;
            for (let i = 0; i < this.cornerCount; ++i) {
                if (before.weights[i] <= 0) this.consider(this.volume.cells[8 * before.cell + 4 + i]);
            }
            this.considerFan(before);
            if (this.best.cell === before.cell) break;
        }
        return this.best;
    }

    /** Takes the closest point of a face if it is closer than the best so far. */
    private consider(cell: number): void {
        if (cell < this.volume.info.innerCellCount || cell >= this.cellCount) return;
        const {weights, square} = closestPoint(this.corners(cell));
        const nearer = this.best.distance * this.best.distance * (1 - 1e-12);
        if (this.best.cell !== kNone && !(square < nearer)) return;
        this.best = {cell, weights, distance: Math.sqrt(square)};
    }

    /** The cells around a corner: edges alone do not lead past a corner that two of them share. */
    private considerFan(around: HullPoint): void {
        const {volume: {cells}} = this;
        const corner = around.weights.findIndex(weight => weight >= 1);
        if (this.cornerCount !== 3 || corner < 0) return;
        const vertex = cells[8 * around.cell + corner];
        let cell = around.cell;
        for (let turn = 0; turn < this.cellCount; ++turn) {
            const place = cells.subarray(8 * cell, 8 * cell + 3).indexOf(vertex);
            if (place < 0) return;
            cell = cells[8 * cell + 4 + (place + 1) % 3];
            if (cell === around.cell || cell >= this.cellCount) return;
            this.consider(cell);
        }
    }

    /** Relative to the position; of flat volumes seen along the normal, or at the foot on the line. */
    private corners(cell: number): Vec3[] {
        const {volume: {cells, positions, info}, local} = this;
        const axis: Vec3 = [info.axis[0], info.axis[1], info.axis[2]];
        return Array.from({length: this.cornerCount}, (_, i) => {
            const at = 3 * cells[8 * cell + i];
            const corner: Vec3 = [0, 1, 2].map(k => positions[at + k] - local[k]) as Vec3;
            if (info.dimension === Dimension.Space) return corner;
            const along = axis.map(x => x * dot(corner, axis)) as Vec3;
            return info.dimension === Dimension.Plane ? minus(corner, along) : along;
        });
    }
}

interface Closest {
    weights: Vec3;
    square: number;
}

/** The point of a triangle, an edge or a corner that is closest to the origin. */
function closestPoint(corners: readonly Vec3[]): Closest {
    const candidates: Vec3[] = corners.length === 1 ? [[1, 0, 0]] : [];
    for (let i = 0; i < (corners.length === 3 ? 3 : corners.length - 1); ++i) {
        const j = (i + 1) % corners.length;
        const fraction = closestOnEdge(corners[i], corners[j]);
        const weights: Vec3 = [0, 0, 0];
        weights[i] = 1 - fraction;
        weights[j] = fraction;
        candidates.push(weights);
    }
    const foot = corners.length === 3 ? footWeights(corners[0], corners[1], corners[2]) : undefined;
    if (foot) candidates.push(foot);
    let best: Closest = {weights: [0, 0, 0], square: Infinity};
    for (const weights of candidates) {
        const point = [0, 1, 2].map(k => corners.reduce((sum, corner, i) => sum + weights[i] * corner[k], 0)) as Vec3;
        if (dot(point, point) < best.square) best = {weights, square: dot(point, point)};
    }
    return best;
}

function closestOnEdge(a: Vec3, b: Vec3): number {
    const edge = minus(b, a);
    const square = dot(edge, edge);
    return square > 0 ? Math.min(Math.max(-dot(a, edge) / square, 0), 1) : 0;
}

/** Weights of the foot of the origin on a triangle's plane, if it is in the triangle. */
function footWeights(a: Vec3, b: Vec3, c: Vec3): Vec3 | undefined {
    const normal = cross(minus(b, a), minus(c, a));
    const square = dot(normal, normal);
    const weights = [cross(b, c), cross(c, a), cross(a, b)].map(area => dot(area, normal) / square) as Vec3;
    return weights.every(weight => weight >= 0) ? weights : undefined;
}
