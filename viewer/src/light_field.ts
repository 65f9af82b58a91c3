// SPDX-License-Identifier: Apache-2.0
// A grid of light over a whole volume, for the scene's surfaces. Its points are located once by one
// query; after that any light of the same probes is blended here, so that sliders relight at once.
import * as three from 'three';

import type {Api} from './api';
import {packedLight} from './packed_light';
import {decodeAnswer, encodeQuery, Locations, WantedSh} from './query_binary';
import {kPacked} from './sh';
import {emptyConstants, LppvUniforms} from './shaders';
import type {Light, Volume} from './volume';

const kMostPoints = 12000;

export interface Grid {
    low: three.Vector3;
    size: three.Vector3;
    resolution: number[];
}

/** At most `kMostPoints` points in a box, about equally far apart along all axes. */
export function gridOf(box: three.Box3): Grid {
    const size = box.getSize(new three.Vector3()).max(new three.Vector3(1e-3, 1e-3, 1e-3));
    const spacing = Math.cbrt(size.x * size.y * size.z / kMostPoints);
    const resolution = size.toArray().map(length => Math.min(64, Math.max(2, Math.floor(length / spacing))));
    return {low: box.min.clone(), size, resolution};
}

export function pointsOf({low, size, resolution: [nx, ny, nz]}: Grid): Float32Array {
    const points: number[] = [];
    for (let z = 0; z < nz; ++z) {
        for (let y = 0; y < ny; ++y) {
            for (let x = 0; x < nx; ++x) {
                points.push(low.x + size.x * x / (nx - 1), low.y + size.y * y / (ny - 1),
                            low.z + size.z * z / (nz - 1));
            }
        }
    }
    return new Float32Array(points);
}

export class LightField {
    readonly uniforms: LppvUniforms = {lppv: {value: null}, lppvConstants: {value: emptyConstants()}};
    private volume: Volume | null = null;
    private places: Locations | null = null;
    private resolution = [1, 1, 1];

    constructor() {
        this.show(new Uint16Array(7 * 4), [1, 1, 1]);
    }

    async place(api: Api, volume: Volume, box: three.Box3): Promise<void> {
        const grid = gridOf(box);
        const body = await api.query(volume.file.id, encodeQuery(pointsOf(grid), WantedSh.None));
        this.places = decodeAnswer(body).locations;
        this.volume = volume;
        this.resolution = grid.resolution;
        // The box's faces are the middles of the outer texels.
        const n = new three.Vector3(...grid.resolution);
        const texel = grid.size.clone().divide(n.clone().subScalar(1));
        const low = grid.low.clone().addScaledVector(texel, -0.5);
        const size = texel.multiply(n);
        const constants = this.uniforms.lppvConstants.value;
        constants.params.set(1, 0, 1 / (7 * n.x), 0);
        constants.low.set(low.x, low.y, low.z, 0);
        constants.size_inverse.set(1 / size.x, 1 / size.y, 1 / size.z, 0);
    }

    /** Fills the texture with the light that probes have now. */
    relight(light: Light): void {
        if (this.places === null || this.volume === null) return;
        const [nx] = this.resolution;
        const texels = new Uint16Array(this.places.count * kPacked);
        const packed = packedLight(this.volume, light, this.places);
        for (let i = 0; i < this.places.count; ++i) {
            const row = Math.floor(i / nx) * 7 * nx + i % nx;
            for (let k = 0; k < kPacked; ++k) {
                const texel = row + Math.floor(k / 4) * nx;
                texels[4 * texel + k % 4] = three.DataUtils.toHalfFloat(packed[i * kPacked + k]);
            }
        }
        this.show(texels, this.resolution);
    }

    clear(): void {
        this.places = null;
        this.show(new Uint16Array(7 * 4), [1, 1, 1]);
    }

    private show(texels: Uint16Array, [nx, ny, nz]: number[]): void {
        this.uniforms.lppv.value?.dispose();
        const texture = new three.Data3DTexture(texels as Uint16Array<ArrayBuffer>, 7 * nx, ny, nz);
        texture.format = three.RGBAFormat;
        texture.type = three.HalfFloatType;
        texture.minFilter = texture.magFilter = three.LinearFilter;
        texture.needsUpdate = true;
        this.uniforms.lppv.value = texture;
    }
}
