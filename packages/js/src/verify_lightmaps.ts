// SPDX-License-Identifier: Apache-2.0
import {checkCount, isPowerOfTwo} from './checks.js';
import {elementError, sectionError} from './error.js';
import {isFiniteHalf, isLightHalf} from './half.js';
import type {LightmapRectangle, Lightmaps} from './lightmaps.js';
import {kNone} from './section_file.js';
import {checkDistinctNames, checkMetadata} from './section_text.js';

const kLargestPageSize = 16384;
const kLargestScale = 2 ** 64;

/** A coverage of 1, a half. */
const kCovered = 0x3c00;

/** How far scale and offset may be from those of the texels. */
const kTransformTolerance = 1e-6;

/** Words of each element of a section that are 0: from one on to the last. */
export type Reserved = Record<string, {words: Uint32Array; from: number; each: number}>;

export function verifyLightmaps(v: Lightmaps, layerNames: readonly string[], reserved: Reserved): void {
    checkInfo(v);
    for (const [section, {words, from, each}] of Object.entries(reserved)) {
        for (let i = 0; i < words.length; ++i) {
            if (i % each >= from && words[i] !== 0) {
                throw elementError(section, Math.floor(i / each), 'has a reserved word that is not zero');
            }
        }
    }
    checkCounts(v, layerNames.length);
    checkDistinctNames('layer_names', layerNames);
    checkMetadata(v.metadata);
    checkMeshes(v);
    v.rectangles.forEach((rectangle, i) => {
        const problem = rectangleProblem(rectangle, v);
        if (problem !== '') throw elementError('rectangles', i, problem);
    });
    checkOverlaps(v.rectangles);
    v.layers.forEach(({weight, scale}, i) => {
        if (!(weight >= 0 && weight < Infinity)) throw elementError('layers', i, `weight ${weight} is out of range`);
        if (!isScale(scale)) throw elementError('layers', i, `scale ${scale} is not a power of two in 2^-64 to 2^64`);
    });
    checkTexels(v);
}

const isScale = (scale: number) => isPowerOfTwo(scale) && scale <= kLargestScale && 1 / scale <= kLargestScale;

function checkInfo(v: Lightmaps): void {
    const error = (what: string) => sectionError('info', what);
    if (v.pageSize > kLargestPageSize || (v.pageSize === 0 && v.pageCount > 0)) {
        throw error(`page size ${v.pageSize} is not in 1 to ${kLargestPageSize}`);
    }
    if (!(v.texelsPerMeter >= 0 && v.texelsPerMeter < Infinity)) {
        throw error(`${v.texelsPerMeter} texels a metre are out of range`);
    }
    if (!isScale(v.scale)) throw error(`scale ${v.scale} is not a power of two in 2^-64 to 2^64`);
    if (v.mixedLighting === undefined) throw error('mixed lighting is not known');
    if (!(v.ambientOcclusionDistance >= 0 && v.ambientOcclusionDistance < Infinity)) {
        throw error(`a distance of ${v.ambientOcclusionDistance} metres is out of range`);
    }
}

function checkCounts(v: Lightmaps, nameCount: number): void {
    const texels = v.pageSize * v.pageSize * v.pageCount;
    checkCount('irradiance', v.irradiance.length / 4, texels, false);
    checkCount('light', v.light.length / 12, texels);
    checkCount('validity', v.validity.length, texels);
    checkCount('error', v.error.length, texels);
    checkCount('shadow_mask', v.shadowMask.length / 4, texels);
    checkCount('ambient_occlusion', v.ambientOcclusion.length, texels);
    checkCount('instance_names', v.instanceNames.length, v.rectangles.length);
    checkCount('layer_names', nameCount, v.layers.length, false);
    checkCount('layer_irradiance', v.layerIrradiance.length / 3, v.layers.length * texels);
    checkCount('layer_light', v.layerLight.length / 12, v.layers.length * texels);
}

function checkMeshes({meshes, cornerUvs}: Lightmaps): void {
    const corners = cornerUvs.length / 2;
    meshes.forEach(({firstCorner, triangleCount}, i) => {
        const end = firstCorner + 3 * triangleCount;
        if (end > corners) {
            throw elementError('meshes', i, `corners ${firstCorner} to ${end} are out of range (${corners})`);
        }
    });
    cornerUvs.forEach((value, i) => {
        if (!(value >= 0 && value <= 1)) throw elementError('corner_uvs', i >> 1, `${value} is not in [0, 1]`);
    });
}

/** What is wrong with a rectangle by itself; empty if nothing is. */
function rectangleProblem(r: LightmapRectangle, {pageSize, pageCount, meshes}: Lightmaps): string {
    if (r.mesh !== kNone && r.mesh >= meshes.length) return `mesh ${r.mesh} is out of range (${meshes.length})`;
    if (r.page === kNone) {
        const numbers = [...r.scale, ...r.offset, r.x, r.y, r.width, r.height];
        return numbers.every(value => value === 0) ? '' : 'has no page, but numbers that are not zero';
    }
    if (r.page >= pageCount) return `page ${r.page} is out of range (${pageCount})`;
    const isInside = r.width > 0 && r.height > 0 && r.x + r.width <= pageSize && r.y + r.height <= pageSize;
    if (!isInside) {
        return `texels ${r.x}, ${r.y} and size ${r.width} x ${r.height} are not inside a page of size ${pageSize}`;
    }
    const expected = [r.width, r.height, r.x, r.y].map(texels => texels / pageSize);
    const isRight = [...r.scale, ...r.offset].every((value, i) => Math.abs(value - expected[i]) <= kTransformTolerance);
    return isRight ? '' : `scale ${r.scale} and offset ${r.offset} are not those of its texels`;
}

/** Rectangles sorted by their left side: each is compared with those that begin before it ends. */
function checkOverlaps(rectangles: readonly LightmapRectangle[]): void {
    const sorted = rectangles.map((r, i) => ({r, i})).filter(({r}) => r.page !== kNone)
        .sort((a, b) => a.r.page - b.r.page || a.r.x - b.r.x || a.i - b.i);
    sorted.forEach(({r: a, i}, place) => {
        for (let k = place + 1; k < sorted.length; ++k) {
            const {r: b, i: other} = sorted[k];
            if (b.page !== a.page || b.x >= a.x + a.width) break;
            if (b.y < a.y + a.height && a.y < b.y + b.height) {
                throw elementError('rectangles', Math.max(i, other), `overlaps rectangle ${Math.min(i, other)}`);
            }
        }
    });
}

function checkTexels(v: Lightmaps): void {
    checkHalves('irradiance', v.irradiance, 4, (half, k) => k < 3 ? isLightHalf(half) : half <= kCovered);
    checkHalves('light', v.light, 12, isLightOfNormals);
    checkHalves('error', v.error, 1, isLightHalf);
    checkHalves('layer_irradiance', v.layerIrradiance, 3, isLightHalf);
    checkHalves('layer_light', v.layerLight, 12, isLightOfNormals);
}

const isLightOfNormals = (half: number, k: number) => k < 3 ? isLightHalf(half) : isFiniteHalf(half);

function checkHalves(section: string, halves: Uint16Array, each: number, isGood: (half: number, k: number) => boolean): void {
    for (let i = 0; i < halves.length; ++i) {
        if (isGood(halves[i], i % each)) continue;
        throw elementError(section, Math.floor(i / each), `half ${i % each} is out of range (0x${halves[i].toString(16)})`);
    }
}
