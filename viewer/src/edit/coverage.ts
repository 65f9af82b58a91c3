// SPDX-License-Identifier: Apache-2.0
// Which places in free space probes light, as `tetralight grid` says it: a place is covered if it lies inside the
// tetrahedra and sees corners of its cell that have a quarter of the weight or more.
import type {Volume} from 'tetralight';

import {Box, contains, volumeOf} from './boxes';
import type {Position} from './groups';
import type {TriangleTree} from './triangle_tree';

export interface SceneSpace {
    tree: TriangleTree;
    low: Position;
    high: Position;
    lamps: readonly Position[];
}

export interface Places {
    positions: readonly Position[];
    /** For each: which of the spaces it is in, of those that places see from one to the next. */
    spaces: Int32Array;
    /** Of each space: light of the sky or of a lamp reaches it. */
    isLit: readonly boolean[];
}

export interface Coverage {
    covered: number;
    outside: readonly Position[];  // of the tetrahedra
    unseen: readonly Position[];   // inside them, out of sight of probes
}

/** Of the places that count. */
export const shareOf = ({covered, outside, unseen}: Coverage) => covered / Math.max(1, covered + outside.length + unseen.length);

const kPlaces = 1500;
const kTries = 4 * kPlaces;
const kDirections = 16;
const kClearance = 0.05;  // metres
const kSeenWeight = 0.25;
const kNeighbors = 12;
const kNearProbes = 16;
const kSliceMilliseconds = 10;

/** Lets the page draw between slices of long work; false: the work is of no use any more. */
export class Slices {
    private start = performance.now();

    constructor(private readonly isWanted: () => boolean) {}

    async next(): Promise<boolean> {
        if (performance.now() - this.start < kSliceMilliseconds) return true;
        await new Promise(resolve => setTimeout(resolve));
        this.start = performance.now();
        return this.isWanted();
    }
}

function halton(index: number, base: number): number {
    let [value, share] = [0, 1];
    for (let i = index; i > 0; i = Math.floor(i / base)) {
        share /= base;
        value += share * (i % base);
    }
    return value;
}

/** Even over the sphere: a Fibonacci lattice. */
const directions = Array.from({length: kDirections}, (_, i): Position => {
    const y = 1 - (2 * i + 1) / kDirections;
    const angle = 2.399963 * i;
    return [Math.sqrt(1 - y * y) * Math.cos(angle), y, Math.sqrt(1 - y * y) * Math.sin(angle)];
});

/** Places in free space, the same each time. Null: not wanted any more. */
export async function findPlaces(space: SceneSpace, slices: Slices): Promise<Places | null> {
    const {low, high, tree, lamps} = space;
    const positions: Position[] = [];
    const isSky: boolean[] = [];
    for (let i = 1; i <= kTries && positions.length < kPlaces; ++i) {
        if (!await slices.next()) return null;
        const p = [2, 3, 5].map((base, a) => low[a] + (high[a] - low[a]) * halton(i, base)) as unknown as Position;
        const hits = directions.map(d => tree.nearest(p, d));
        const backs = hits.filter(hit => hit?.isBack).length;
        if (backs > kDirections / 4 || hits.some(hit => hit !== null && hit.distance < kClearance)) continue;
        positions.push(p);
        isSky.push(hits.includes(null));
    }
    const spaces = await joinSpaces(positions, tree, slices);
    if (spaces === null) return null;
    const isLit: boolean[] = [];
    positions.forEach((p, i) => {
        isLit[spaces[i]] ||= isSky[i] || lamps.some(lamp => tree.isFree(p, lamp));
    });
    return {positions, spaces, isLit};
}

/** Numbers places so that those that see each other have the same. */
async function joinSpaces(positions: readonly Position[], tree: TriangleTree, slices: Slices): Promise<Int32Array | null> {
    const parents = Int32Array.from(positions, (_, i) => i);
    const rootOf = (i: number) => {
        while (parents[i] !== i) i = parents[i] = parents[parents[i]];
        return i;
    };
    for (let i = 0; i < positions.length; ++i) {
        if (!await slices.next()) return null;
        for (const j of nearestTo(positions[i], positions, kNeighbors + 1)) {
            if (rootOf(i) !== rootOf(j) && tree.isFree(positions[i], positions[j])) parents[rootOf(i)] = rootOf(j);
        }
    }
    return parents.map((_, i) => rootOf(i));
}

/** The indices of the nearest, in no order. */
export function nearestTo(p: Position, positions: readonly Position[], count: number): number[] {
    const best: number[] = [];
    const distances: number[] = [];
    for (let i = 0; i < positions.length; ++i) {
        const [x, y, z] = positions[i];
        const distance = (x - p[0]) ** 2 + (y - p[1]) ** 2 + (z - p[2]) ** 2;
        let at = best.length;
        if (at === count && distance >= distances[at - 1]) continue;
        while (at > 0 && distances[at - 1] > distance) --at;
        best.splice(at, 0, i);
        distances.splice(at, 0, distance);
        if (best.length > count) {
            best.pop();
            distances.pop();
        }
    }
    return best;
}

/** The smallest adjustment volume that says so forbids probes here. */
export function isForbidden(boxes: readonly Box[], p: Position): boolean {
    const around = boxes.filter(box => box.kind === 'adjustments' && box.settings.forbid !== undefined && contains(box, p));
    return around.sort((a, b) => volumeOf(a) - volumeOf(b))[0]?.settings.forbid === true;
}

/** Null: not wanted any more. */
export async function findCoverage(space: SceneSpace, places: Places, probes: Volume | null, boxes: readonly Box[],
                                   slices: Slices): Promise<Coverage | null> {
    const probePositions = probes === null ? [] : Array.from({length: probes.probeCount}, (_, i): Position => probes.position(i));
    const reached = new Set<number>();
    const found: {p: Position; space: number; kind: 'covered' | 'outside' | 'unseen'; isNear: boolean}[] = [];
    for (const [i, p] of places.positions.entries()) {
        if (!await slices.next()) return null;
        if (isForbidden(boxes, p)) continue;
        const seen = seenFrom(space.tree, p, probes, probePositions);
        if (seen.isNear) reached.add(places.spaces[i]);
        found.push({p, space: places.spaces[i], ...seen});
    }
    const counts = found.filter(({space: number, kind, isNear}) => kind === 'outside' && probePositions.length > 0 ? isNear :
        places.isLit[number] || reached.has(number));
    const of = (kind: string) => counts.filter(each => each.kind === kind).map(({p}) => p);
    return {covered: of('covered').length, outside: of('outside'), unseen: of('unseen')};
}

/** `isNear`: a corner of the cell, or outside of the tetrahedra one of the nearest probes, is in sight. */
function seenFrom(tree: TriangleTree, p: Position, probes: Volume | null, positions: readonly Position[]):
    {kind: 'covered' | 'outside' | 'unseen'; isNear: boolean} {
    if (probes === null || positions.length === 0) return {kind: 'outside', isNear: false};
    const {cell, probes: corners, weights} = probes.locate(p);
    const isInside = cell < probes.data.info.innerCellCount;
    let [seen, isNear] = [0, false];
    corners.forEach((probe, i) => {
        if (!tree.isFree(p, positions[probe])) return;
        seen += weights[i];
        isNear = true;
    });
    if (isInside) return {kind: seen >= kSeenWeight ? 'covered' : 'unseen', isNear};
    isNear ||= nearestTo(p, positions, kNearProbes).some(probe => tree.isFree(p, positions[probe]));
    return {kind: 'outside', isNear};
}
