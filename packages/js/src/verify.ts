// SPDX-License-Identifier: Apache-2.0
// Checks the meaning of every number of a volume, so that queries need not: docs/file_format.md#opening.
import {checkCount, checkEach, isPowerOfTwo, isUnit, kLargestCoefficient} from './checks.js';
import {elementError, sectionError} from './error.js';
import {isFiniteHalf} from './half.js';
import {checkMetadata} from './section_text.js';
import {checkLights} from './verify_lights.js';
import {checkLayers} from './verify_layers.js';
import {checkSeedGrid} from './verify_seed_grid.js';
import {checkVisibility} from './verify_visibility.js';
import {Dimension, kHealthSize, kNone, vertexCount, VolumeData} from './volume_data.js';

/** No position is farther from the origin of the world, metres. */
const kFarthestPosition = 1e18;

export function verify(volume: VolumeData): void {
    checkCounts(volume);
    checkProbes(volume);
    checkInfo(volume);
    checkCells(volume);
    checkTables(volume);
    checkLights(volume);
    checkLayers(volume);
}

const infoError = (what: string) => sectionError('info', what);

function checkCounts(v: VolumeData): void {
    const {dimension, innerCellCount} = v.info;
    const probes = v.positions.length / 3;
    const cells = v.cells.length / 8;
    if (dimension > Dimension.Space) throw infoError(`dimension ${dimension} is unknown`);
    if (innerCellCount > cells) throw infoError(`inner cell count ${innerCellCount} is more than the ${cells} cells`);
    if (cells > (dimension === Dimension.None ? 0 : dimension === Dimension.Point ? innerCellCount : cells)) {
        throw infoError(`dimension ${dimension} does not go with ${cells} cells`);
    }
    if (innerCellCount > 0) {
        const count = v.cells.subarray(0, 4).filter(vertex => vertex !== kNone).length;
        if (count !== dimension) throw infoError(`dimension ${dimension} does not go with cells of ${count} vertices`);
    }
    checkCount('irradiance', v.irradiance.length / 27, probes);
    checkCount('occlusion', v.occlusion.length / 4, probes);
    checkCount('validity', v.validity.length, probes);
    checkCount('health', v.health.byteLength / kHealthSize, probes);
    checkCount('compact', v.compact.length / 32, probes);
    checkCount('exact_positions', v.exactPositions.length / 3, probes);
    checkCount('rendering_layers', v.renderingLayers.length, probes);
    checkCount('hull_rays', v.hullRays.length / 9, cells - innerCellCount, false);
}

function checkProbes(v: VolumeData): void {
    const isFraction = (x: number) => x >= 0 && x <= 1;
    checkEach('positions', v.positions, 3, 'is not finite', Number.isFinite);
    checkEach('exact_positions', v.exactPositions, 3, 'is not finite', Number.isFinite);
    checkEach('irradiance', v.irradiance, 27, 'is not finite, or above 1e37', x => Math.abs(x) <= kLargestCoefficient);
    checkEach('compact', v.compact, 32, 'is not finite', isFiniteHalf);
    checkEach('occlusion', v.occlusion, 4, 'is not in [0, 1]', isFraction);
    checkEach('validity', v.validity, 1, 'is not in [0, 1]', isFraction);
    checkEach('rendering_layers', v.renderingLayers, 1, 'is on no layer', layers => layers !== 0);
    for (let i = 0; i * kHealthSize < v.health.byteLength; ++i) {
        const number = (at: number) => v.health.getFloat32(i * kHealthSize + at, true);
        const isPlausible = Number.isFinite(number(0)) && number(0) >= 0 && number(4) >= 0 &&
                            [8, 12, 16].every(at => Math.abs(number(at)) <= kFarthestPosition) &&
                            v.health.getUint32(i * kHealthSize + 20, true) <= 1;
        if (!isPlausible) throw elementError('health', i, 'is not in range');
    }
    checkRays(v);
}

function checkRays({hullRays, info}: VolumeData): void {
    const count = Math.max(info.dimension - 1, 0);
    for (let at = 0; at < hullRays.length; at += 9) {
        for (let i = 0; i < count; ++i) {
            if (!isUnit(hullRays.subarray(at + 3 * i, at + 3 * i + 3), 1e-3)) {
                throw elementError('hull_rays', at / 9, 'is not a unit vector');
            }
        }
    }
}

const isNear = (v: Float64Array) => v.every(x => Math.abs(x) <= kFarthestPosition);

function checkInfo({info, positions, compact}: VolumeData): void {
    const {origin, axis, dimension, seedCube} = info;
    if (!isNear(origin)) throw infoError(`the origin is not within ${kFarthestPosition} m`);
    if (!info.ambient.every(x => Math.abs(x) <= kLargestCoefficient)) {
        throw infoError('a coefficient of ambient light is not finite, or above 1e37');
    }
    if (!(info.radialFraction >= 0 && info.radialFraction <= 1)) {
        throw infoError(`radial fraction ${info.radialFraction} is not from 0 to 1`);
    }
    if (compact.length > 0 && !isPowerOfTwo(info.compactScale)) {
        throw infoError(`scale ${info.compactScale} of compact probes is not a power of two`);
    }
    if (dimension !== Dimension.Line && dimension !== Dimension.Plane) {
        if (axis.some(x => x !== 0)) throw infoError('only lines and planes have an axis');
    } else if (!isUnit(axis, 1e-9)) {
        throw infoError('the axis is not a unit vector');
    }
    if (!isNear(seedCube.subarray(0, 3)) || !(Number.isFinite(seedCube[3]) && seedCube[3] >= 0)) {
        throw infoError('the cube of the seeds is not a cube');
    }
    checkExtent(info.extent, positions);
}

/** From `extent` follows which positions are far away: too small a one would move them. */
function checkExtent(extent: number, positions: Float32Array): void {
    let farthest = 0;
    for (let i = 0; i < positions.length; i += 3) {
        farthest = Math.max(farthest, Math.hypot(positions[i], positions[i + 1], positions[i + 2]));
    }
    if (Math.abs(extent - farthest) <= 1e-6 * farthest) return;
    throw infoError(`extent ${extent} m; the farthest probe is at ${farthest} m`);
}

function checkCells(v: VolumeData): void {
    for (let cell = 0; cell < v.cells.length / 8; ++cell) checkCell(v, cell);
}

function checkCell(v: VolumeData, cell: number): void {
    const count = vertexCount(v, cell);
    const isInner = cell < v.info.innerCellCount;
    for (let i = 0; i < 4; ++i) {
        const hasNeighbor = i < count ? count > 1 : i === 3 && !isInner;
        const neighbor = v.cells[8 * cell + 4 + i];
        checkIndex(cell, 'vertex', v.cells[8 * cell + i], i < count, v.positions.length / 3);
        checkIndex(cell, 'neighbor', neighbor, hasNeighbor, v.cells.length / 8);
        if (hasNeighbor && !isNeighbor(v.cells, cell, i)) {
            throw elementError('cells', cell, `cell ${neighbor} is not its neighbor`);
        }
        for (let k = 0; k < i && hasNeighbor; ++k) {
            if (v.cells[8 * cell + 4 + k] === neighbor) {
                throw elementError('cells', cell, `cell ${neighbor} is its neighbor twice`);
            }
        }
    }
}

function checkIndex(cell: number, what: string, index: number, isUsed: boolean, count: number): void {
    if (isUsed ? index < count : index === kNone) return;
    throw elementError('cells', cell, `${what} ${index} is out of range (${isUsed ? count : 0})`);
}

/** A neighbor lists the cell as its neighbor, and has all vertices of the cell but one. */
function isNeighbor(cells: Uint32Array, cell: number, face: number): boolean {
    const here = 8 * cell;
    const there = 8 * cells[here + 4 + face];
    if (!hasIndex(cells, there + 4, cell)) return false;
    for (let i = 0; i < 4; ++i) {
        const vertex = cells[here + i];
        if (i !== face && vertex !== kNone && !hasIndex(cells, there, vertex)) return false;
    }
    return true;
}

function hasIndex(cells: Uint32Array, at: number, index: number): boolean {
    return cells[at] === index || cells[at + 1] === index || cells[at + 2] === index || cells[at + 3] === index;
}

function checkTables(v: VolumeData): void {
    checkMetadata(v.metadata);
    checkSortedNames(v.groupNames);
    checkSeeds(v);
    checkSeedGrid(v.seedGrid, v.cells.length / 8);
    checkVisibility(v);
    const probes = v.positions.length / 3;
    for (let at = 0; at < v.sources.length; at += 3) {
        const [group, index, probe] = v.sources.subarray(at, at + 3);
        if (group >= v.groupNames.length || (probe >= probes && probe !== kNone)) {
            throw elementError('sources', at / 3, 'is out of range');
        }
        const isLater = at === 0 || v.sources[at - 3] < group ||
                        (v.sources[at - 3] === group && v.sources[at - 2] <= index);
        if (!isLater) throw sectionError('sources', 'is not sorted');
    }
}

/** In the order of their bytes, which is that of their code points. */
function checkSortedNames(names: readonly string[]): void {
    const encoder = new TextEncoder();
    for (let i = 1; i < names.length; ++i) {
        const [before, after] = [names[i - 1], names[i]].map(name => encoder.encode(name));
        let k = 0;
        while (k < before.length && before[k] === after[k]) ++k;
        const isSorted = k === before.length ? after.length > k : before[k] < after[k];
        if (!isSorted) throw sectionError('group_names', `name ${i} is not in sorted order`);
    }
}

function checkSeeds({seeds, cells}: VolumeData): void {
    for (let at = 0; at < seeds.length; at += 4) {
        if (seeds[at + 2] >= cells.length / 8) throw elementError('seeds', at / 4, 'is out of range');
        const isLater = at === 0 || seeds[at + 1] > seeds[at - 3] ||
                        (seeds[at + 1] === seeds[at - 3] && seeds[at] >= seeds[at - 4]);
        if (!isLater) throw sectionError('seeds', 'is not sorted');
    }
}
