// SPDX-License-Identifier: Apache-2.0
// Finds the cell of a position by walking from cell to cell (Devillers, Pion & Teillaud 2002, "Walking in a
// Triangulation"). A walk always ends: where cells are flatter than rounding, searches of ever more cells follow.
import {CellWeights} from './cell_weights.js';
import {SeedGrid} from './seed_grid.js';
import {kNone, VolumeData} from './volume_data.js';

/** Cells that are searched around the end of a walk that failed: of the first walk, and of the last. */
const kCellsNear = 128;
const kMostCellsNear = 1024;

/** If two neighbors send the walk to each other by more than this, it goes in a circle. */
const kSettleTolerance = 1e-9;

const kMostRandomSteps = 2048;

/** One random step in so many is by any face: hull cells that fold over each other can send a walk in a circle. */
const kStray = 8;

export class Walk {
    /** Barycentric weights of the answer: ≥ 0, sum 1. */
    readonly weights = new Float64Array(4);
    private readonly at: CellWeights;
    private readonly seeds: SeedGrid;

    constructor(private readonly volume: VolumeData) {
        this.at = new CellWeights(volume);
        this.seeds = new SeedGrid(volume.seedGrid);
    }

    /** The cell of a world position, walking from `hint`, or from the seed grid if that is not a cell. */
    locate(x: number, y: number, z: number, hint: number): number {
        const {at} = this;
        if (at.cellCount === 0 || !at.moveTo(x, y, z)) return this.fail();
        const index = hint >>> 0;  // any number is allowed
        const start = index < at.cellCount ? index : this.seedCell();
        const found = this.walkFrom(start, kCellsNear);
        return found !== kNone ? found : this.locateAnyhow();
    }

    private fail(): number {
        this.weights.fill(0);
        return kNone;
    }

    private seedCell(): number {
        const {q, cellCount} = this.at;
        const cell = this.seeds.find(q[0], q[1], q[2]);
        return cell < cellCount ? cell : 0;
    }

    private locateAnyhow(): number {
        let found = this.wanderFrom(this.seedCell());
        if (found === kNone) found = this.walkFrom(this.seedCell(), kMostCellsNear);
        return found !== kNone ? found : this.searchAll();
    }

    /**
     * Leaves each cell by the face of its most negative weight. The next cell depends on the current one alone: a walk
     * that returns to a cell goes in a circle, which a landmark that is replaced after 1, 2, 4 … steps finds (Brent 1980).
     */
    private walkFrom(start: number, cellsNear: number): number {
        const {at, volume: {cells}} = this;
        const {w} = at;
        let cell = start;
        let landmark = kNone;
        let previous = kNone;
        let previousMeasure = 0;
        for (let step = 1; cell !== landmark; ++step) {
            if ((step & step - 1) === 0) landmark = cell;
            if (at.contains(cell)) return this.finish(cell);
            const next = cells[8 * cell + 4 + mostNegative(w)];
            if (next === previous) {
                // Each of two cells sends the walk to the other: on their common face that is rounding.
                if (Math.max(w[4], previousMeasure) < -kSettleTolerance) break;
                const nearer = w[4] >= previousMeasure ? cell : previous;
                at.contains(nearer);
                return this.finish(nearer);
            }
            if (next === kNone) break;
            previous = cell;
            previousMeasure = w[4];
            cell = next;
        }
        return this.searchNear(cell, cellsNear);
    }

    /** Leaves each cell by any face that the position lies beyond, and so goes in no circle for long. */
    private wanderFrom(start: number): number {
        const {at, volume: {cells}} = this;
        let random = 1;  // the same numbers for each position
        const draw = (count: number) => (random = random * 48271 % 2147483647) % count;
        let cell = start;
        for (let step = 0; step < kMostRandomSteps && cell !== kNone; ++step) {
            if (at.contains(cell)) return this.finish(cell);
            const beyond = [0, 1, 2, 3].filter(i => at.w[i] < 0);
            const isLost = beyond.length === 0 || draw(kStray) === 0;
            cell = cells[8 * cell + 4 + (isLost ? draw(4) : beyond[draw(beyond.length)])];
        }
        return kNone;
    }

    /** However cells fold, one that faces the right way contains the position, and it is near. */
    private searchNear(start: number, count: number): number {
        const {volume: {cells}} = this;
        const found = new Set([start]);
        let best = kNone;
        let bestMeasure = -kSettleTolerance;
        for (const cell of found) {
            this.at.contains(cell);
            const {measure} = this.at;
            if (measure >= bestMeasure && (best === kNone || measure > bestMeasure)) {
                best = this.finish(cell);
                bestMeasure = measure;
            }
            if (bestMeasure >= 0) break;
            for (let i = 4; i < 8; ++i) {
                const neighbor = cells[8 * cell + i];
                if (neighbor !== kNone && found.size < count) found.add(neighbor);
            }
        }
        return best;
    }

    /** The fallback that cannot fail: the cell that is nearest to containing the position, or the nearest probe. */
    private searchAll(): number {
        let best = kNone;
        let bestMeasure = -Infinity;
        for (let cell = 0; cell < this.at.cellCount; ++cell) {
            this.at.contains(cell);
            if (!(this.at.measure > bestMeasure)) continue;
            bestMeasure = this.at.measure;
            best = this.finish(cell);
        }
        return best !== kNone ? best : this.nearestCorner();
    }

    private nearestCorner(): number {
        const {at: {q}, volume: {cells, positions}} = this;
        let nearest = kNone;
        let least = Infinity;
        this.weights.fill(0);
        for (let place = 0; place < cells.length; ++place) {
            if (place % 8 > 3 || cells[place] === kNone) continue;
            const p = 3 * cells[place];
            const square = (positions[p] - q[0]) ** 2 + (positions[p + 1] - q[1]) ** 2 + (positions[p + 2] - q[2]) ** 2;
            if (!(square < least)) continue;
            least = square;
            nearest = place >> 3;
            this.weights.fill(0)[place % 8] = 1;
        }
        return nearest;
    }

    /** Takes the weights of the cell that was weighed last as the answer, rounded to floats as other languages have them. */
    private finish(cell: number): number {
        const {weights, at: {w}} = this;
        const a = Math.max(w[0], 0), b = Math.max(w[1], 0), c = Math.max(w[2], 0), d = Math.max(w[3], 0);
        const sum = a + c + (b + d);
        weights[0] = Math.fround(a / sum);
        weights[1] = Math.fround(b / sum);
        weights[2] = Math.fround(c / sum);
        weights[3] = Math.fround(d / sum);
        return cell;
    }
}

function mostNegative(w: Float64Array): number {
    let lowest = 0;
    if (w[1] < w[0]) lowest = 1;
    if (w[2] < w[lowest]) lowest = 2;
    return w[3] < w[lowest] ? 3 : lowest;
}
