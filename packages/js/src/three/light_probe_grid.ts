// SPDX-License-Identifier: Apache-2.0
// The light of a volume as the grid that the WebGL renderer of three.js reads (LightProbeGridWebGL, three r187).
import * as three from 'three';

import {argumentError} from '../error.js';
import type {QueryOptions} from '../query_options.js';
import {kCoefficients, kCosine} from '../sh.js';
import type {Volume} from '../volume.js';

/** RGBA texels of the 27 coefficients of a probe. */
const kTexels = 7;

/** As of `tetralight export`. */
const kMostCellsOfAxis = 2048, kMostCells = 2 ** 22;

/** A light that the renderer takes as a grid of probes. It lights everything in its box that receives light. */
export class VolumeGrid extends three.Light {
    readonly isLightProbeGrid = true;
    readonly boundingBox = new three.Box3();
    readonly resolution = new three.Vector3();
    /** Where grids overlap, that of the highest priority counts. */
    priority = 0;
    texture: three.Data3DTexture | null = null;

    override dispose(): void {
        this.texture?.dispose();
        super.dispose();
    }
}

/**
 * The light at the centers of nx × ny × nz cells of a world box. In the grid light passes through walls that are thinner
 * than its cells, and the box has sides along the axes of the world.
 */
export function toLightProbeGrid(volume: Volume, box: three.Box3, resolution: readonly [number, number, number],
                                 options: Pick<QueryOptions, 'outside' | 'fadeDistance' | 'walls'> = {}): VolumeGrid {
    const [nx, ny, nz] = resolution;
    if (!resolution.every(count => Number.isInteger(count) && count > 0 && count <= kMostCellsOfAxis) ||
        nx * ny * nz > kMostCells) {
        throw argumentError('resolution', `is (${resolution.join(', ')}); whole numbers from 1 to ${kMostCellsOfAxis}, and at ` +
                                          `most ${kMostCells} cells, are possible`);
    }
    if (box.isEmpty()) throw argumentError('box', 'is empty');
    const size = box.getSize(new three.Vector3());
    const positions = new Float32Array(3 * nx * ny * nz);
    let at = 0;
    for (let z = 0; z < nz; ++z) {
        for (let y = 0; y < ny; ++y) {
            for (let x = 0; x < nx; ++x) {
                positions[at++] = box.min.x + (x + 0.5) * size.x / nx;
                positions[at++] = box.min.y + (y + 0.5) * size.y / ny;
                positions[at++] = box.min.z + (z + 0.5) * size.z / nz;
            }
        }
    }
    const sh = new Float32Array(kCoefficients * nx * ny * nz);
    volume.batch(positions, {sh}, options);
    return makeGrid(box, resolution, makeTexels(sh, nx, ny, nz));
}

/** The JSON file that `tetralight export --as three-grid` writes. */
export interface GridFile {
    min: readonly number[];
    max: readonly number[];
    resolution: readonly number[];
    /** Texels of the texture along each axis. */
    texture: readonly number[];
    /** Name of the file of the texture, beside this one. */
    data: string;
}

/** The grid of an export: its JSON, and the bytes of the file that `data` names. */
export function readLightProbeGrid(file: GridFile, data: ArrayBuffer): VolumeGrid {
    const [nx, ny, nz] = file.resolution;
    const size = 4 * 4 * kTexels * nx * ny * (nz + 2);
    if (data.byteLength !== size) throw argumentError('data', `has ${data.byteLength} bytes instead of ${size}`);
    const box = new three.Box3(new three.Vector3().fromArray(file.min), new three.Vector3().fromArray(file.max));
    return makeGrid(box, [nx, ny, nz], new Float32Array(data));
}

function makeGrid(box: three.Box3, [nx, ny, nz]: readonly [number, number, number], texels: Float32Array<ArrayBuffer>): VolumeGrid {
    const grid = new VolumeGrid();
    grid.boundingBox.copy(box);
    grid.resolution.set(nx, ny, nz);
    grid.texture = new three.Data3DTexture(texels, nx, ny, kTexels * (nz + 2));
    grid.texture.type = three.FloatType;
    grid.texture.minFilter = grid.texture.magFilter = three.LinearFilter;
    grid.texture.needsUpdate = true;
    return grid;
}

/** Seven volumes along z, each with a copy of its first and of its last slice beside them. */
function makeTexels(sh: Float32Array, nx: number, ny: number, nz: number): Float32Array<ArrayBuffer> {
    const slices = nz + 2;
    const each = nx * ny;
    const texels = new Float32Array(4 * each * kTexels * slices);
    for (let texel = 0; texel < kTexels; ++texel) {
        for (let slice = 0; slice < slices; ++slice) {
            const z = Math.min(Math.max(slice - 1, 0), nz - 1);
            for (let i = 0; i < each; ++i) {
                const from = kCoefficients * (z * each + i);
                const to = 4 * ((texel * slices + slice) * each + i);
                for (let k = 4 * texel; k < Math.min(4 * texel + 4, kCoefficients); ++k) {
                    texels[to + k - 4 * texel] = sh[from + k] / kCosine[Math.floor(k / 3)];
                }
            }
        }
    }
    return texels;
}
