// SPDX-License-Identifier: Apache-2.0
// The steps of a query before its light: cell and weights, the light outside, walls, rendering layers.
import {closestHullPoint} from './closest_hull_point.js';
import {EdgeVisibility, findVisibility} from './edge_visibility.js';
import {kAllRenderingLayers, QuerySettings} from './query_options.js';
import {kNone, VolumeData} from './volume_data.js';
import {Walk} from './walk.js';

/** What remains of the weight of a probe on none of the object's rendering layers. */
const kOtherLayersShare = 1e-4;

/** A query in progress. Its members hold the state after the last step. */
export class Query {
    cell = kNone;
    /** Of the cell's vertices; with `ambient` their sum is 1. */
    readonly weights: Float64Array;
    /** The fraction of ambient light. */
    ambient = 1;
    private readonly walk: Walk;
    private readonly visibility = new EdgeVisibility();
    private readonly distances = new Float64Array(4);
    private readonly hasWalls: boolean;

    constructor(private readonly volume: VolumeData) {
        this.walk = new Walk(volume);
        this.weights = this.walk.weights;
        this.hasWalls = volume.visibilityBlocks.length > 0;
    }

    /** Finds the cell and the barycentric weights of a world position. */
    locate(x: number, y: number, z: number, hint: number, settings: QuerySettings): void {
        this.cell = this.walk.locate(x, y, z, hint);
        this.ambient = this.cell === kNone ? 1 : 0;
        if (settings.outside !== 'extrapolate' && this.cell >= this.volume.info.innerCellCount && this.cell !== kNone) {
            this.clampToHull(x, y, z, settings);
        }
    }

    /** How far a position on a surface is pushed off along its unit normal, metres. `locate` comes before. */
    pushDistance(settings: QuerySettings): number {
        const {weights} = this;
        const sum = weights[0] + weights[1] + weights[2] + weights[3];
        if (this.cell === kNone || !(sum > 0)) return 0;
        this.measureDistances();
        let mean = 0;
        for (let i = 0; i < 4; ++i) mean += weights[i] * this.distances[i];
        return settings.normalOffset * (mean / sum);
    }

    /** Changes the weights by walls and by rendering layers. Their sum stays. */
    hide(settings: QuerySettings, radius: number, renderingLayers: number): void {
        if (this.cell === kNone) return;
        if (this.hasWalls && settings.hidesProbes) {
            const at = findVisibility(this.volume, this.cell);
            if (at !== kNone) {
                if (radius > 0) this.measureDistances();
                this.visibility.hide(this.volume.cellVisibility, at, this.weights, radius, this.distances);
            }
        }
        if (renderingLayers !== kAllRenderingLayers) this.excludeLayers(renderingLayers);
    }

    private clampToHull(x: number, y: number, z: number, settings: QuerySettings): void {
        const {volume, weights} = this;
        const {origin, extent} = volume.info;
        const local = Float64Array.of(x - origin[0], y - origin[1], z - origin[2]);
        const length = Math.hypot(...local);
        const far = 65536 * extent;
        const scale = far > 0 && length > far ? far / length : 1;
        const point = closestHullPoint(volume, local.map(c => c * scale), this.cell);
        const sum = point.weights[0] + point.weights[1] + point.weights[2];
        const distance = point.distance + length * (1 - scale);
        this.cell = point.cell;
        this.ambient = settings.outside === 'ambient' ? Math.fround(Math.min(1, distance / settings.fadeDistance)) : 0;
        for (let i = 0; i < 3; ++i) weights[i] = Math.fround(point.weights[i] / sum) * (1 - this.ambient);
        weights[3] = 0;
    }

    /** Distances from the place that the weights stand for to the vertices; 0 to those without weight. */
    private measureDistances(): void {
        const {weights, distances, volume: {cells, positions}} = this;
        const sum = weights[0] + weights[1] + weights[2] + weights[3];
        let x = 0, y = 0, z = 0;
        for (let i = 0; i < 4; ++i) {
            if (!(weights[i] > 0)) continue;
            const at = 3 * cells[8 * this.cell + i];
            x += weights[i] * positions[at] / sum;
            y += weights[i] * positions[at + 1] / sum;
            z += weights[i] * positions[at + 2] / sum;
        }
        for (let i = 0; i < 4; ++i) {
            const at = 3 * cells[8 * this.cell + i];
            distances[i] =
                weights[i] > 0 ? Math.hypot(x - positions[at], y - positions[at + 1], z - positions[at + 2]) : 0;
        }
    }

    private excludeLayers(mask: number): void {
        const {weights, volume: {cells, renderingLayers}} = this;
        if (renderingLayers.length === 0) return;
        const before = weights[0] + weights[1] + (weights[2] + weights[3]);
        for (let i = 0; i < 4; ++i) {
            if (weights[i] > 0 && (renderingLayers[cells[8 * this.cell + i]] & mask) === 0) {
                weights[i] *= kOtherLayersShare;
            }
        }
        const sum = weights[0] + weights[1] + (weights[2] + weights[3]);
        if (sum === before || !(sum > 0)) return;
        for (let i = 0; i < 4; ++i) weights[i] *= before / sum;
    }
}
