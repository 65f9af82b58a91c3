// SPDX-License-Identifier: Apache-2.0
// The light of a volume as a proxy volume of seven slabs, the 3D texture that runtime/shaders/lppv.glsl samples. The cells
// of its grid points are kept, so that another light of the same probes is found at once.
import {kNone, kPacked} from 'tetralight';
import * as three from 'three';

import type {Answers} from './answers';
import {emptyConstants, LppvConstants, LppvUniforms} from './shaders';

const kMostPoints = 12000;

/** Its outer points are on the faces of its box. */
export interface Grid {
    low: three.Vector3;
    size: three.Vector3;
    resolution: number[];  // at least 2 along each axis
}

/** At most `kMostPoints` points in a box, about equally far apart along all axes. */
export function gridOf(box: three.Box3): Grid {
    const size = box.getSize(new three.Vector3()).max(new three.Vector3(1e-3, 1e-3, 1e-3));
    const spacing = Math.cbrt(size.x * size.y * size.z / kMostPoints);
    const resolution = size.toArray().map(length => Math.min(64, Math.max(2, Math.floor(length / spacing))));
    return {low: box.min.clone(), size, resolution};
}

export function pointsOf({low, size, resolution: [nx, ny, nz]}: Grid): Float32Array {
    const points = new Float32Array(3 * nx * ny * nz);
    let at = 0;
    for (let z = 0; z < nz; ++z) {
        for (let y = 0; y < ny; ++y) {
            for (let x = 0; x < nx; ++x) {
                points[at++] = low.x + size.x * x / (nx - 1);
                points[at++] = low.y + size.y * y / (ny - 1);
                points[at++] = low.z + size.z * z / (nz - 1);
            }
        }
    }
    return points;
}

export class LightField {
    private readonly constants: LppvConstants = emptyConstants();
    private texture: three.Data3DTexture | null = null;
    readonly uniforms: LppvUniforms = {lppv: {value: null}, lppvConstants: {value: this.constants}};
    private volume: Answers | null = null;
    private points: Float32Array = new Float32Array();
    private cells = new Uint32Array();
    private resolution = [1, 1, 1];
    private grid: Grid | null = null;
    /** Lights of sides of a comparison in the same grid. */
    private readonly others = new Map<Answers, LightField>();

    constructor() {
        this.clear();
    }

    /** Fills a grid with the light that a volume has now. */
    place(volume: Answers, grid: Grid): void {
        this.volume = volume;
        this.grid = grid;
        this.points = pointsOf(grid);
        this.cells = new Uint32Array(this.points.length / 3).fill(kNone);
        this.resolution = grid.resolution;
        // The box's faces are the middles of the outer texels.
        const n = new three.Vector3(...grid.resolution);
        const texel = grid.size.clone().divide(n.clone().subScalar(1));
        const low = grid.low.clone().addScaledVector(texel, -0.5);
        const size = texel.multiply(n);
        const {constants} = this;
        constants.params.set(1, 0, 1 / (7 * n.x), 0);
        constants.low.set(low.x, low.y, low.z, 0);
        constants.size_inverse.set(1 / size.x, 1 / size.y, 1 / size.z, 0);
        this.relight();
    }

    /** The same after the light of the volume changed. */
    relight(): void {
        this.forgetOthers();
        if (this.volume === null) return;
        const [nx] = this.resolution;
        const packed = new Float32Array(this.cells.length * kPacked);
        this.volume.batch(this.points, {packed, hints: this.cells});
        const texels = new Uint16Array(packed.length);
        for (let i = 0; i < this.cells.length; ++i) {
            const row = Math.floor(i / nx) * 7 * nx + i % nx;
            for (let k = 0; k < kPacked; ++k) {
                const texel = row + Math.floor(k / 4) * nx;
                texels[4 * texel + k % 4] = three.DataUtils.toHalfFloat(packed[i * kPacked + k]);
            }
        }
        this.show(texels, this.resolution);
    }

    /** What this field lights shows another one, until `null`. */
    showOther(other: LightField | null): void {
        const {texture, constants} = other ?? this;
        this.uniforms.lppv.value = texture;
        this.uniforms.lppvConstants.value = constants;
    }

    /** The same for another light in the same grid. */
    showLight(answers: Answers | null): void {
        if (answers !== null && this.grid !== null && !this.others.has(answers)) {
            const field = new LightField();
            field.place(answers, this.grid);
            this.others.set(answers, field);
        }
        this.showOther(answers === null ? null : this.others.get(answers) ?? null);
    }

    private forgetOthers(): void {
        for (const field of this.others.values()) field.texture?.dispose();
        this.others.clear();
    }

    clear(): void {
        this.forgetOthers();
        this.grid = null;
        this.volume = null;
        this.show(new Uint16Array(7 * 4), [1, 1, 1]);
    }

    private show(texels: Uint16Array<ArrayBuffer>, [nx, ny, nz]: number[]): void {
        this.texture?.dispose();
        const texture = new three.Data3DTexture(texels, 7 * nx, ny, nz);
        texture.format = three.RGBAFormat;
        texture.type = three.HalfFloatType;
        texture.minFilter = texture.magFilter = three.LinearFilter;
        texture.needsUpdate = true;
        this.texture = this.uniforms.lppv.value = texture;
    }
}
