// SPDX-License-Identifier: Apache-2.0
// The light of each instance of an `InstancedMesh` or a `BatchedMesh`, as a texture.
import * as three from 'three';

import type {BatchOptions} from '../batch.js';
import {kNone} from '../section_file.js';
import {kPacked} from '../sh.js';
import type {Volume} from '../volume.js';
import {centerOfBounds} from './bounds.js';
import {PackedTexture} from './packed_texture.js';

export type InstancesMesh = three.InstancedMesh | three.BatchedMesh;

const isBatched = (mesh: InstancesMesh): mesh is three.BatchedMesh => (mesh as three.BatchedMesh).isBatchedMesh === true;

/** Keeps the light of instances that did not move: an update costs in proportion to those that did. */
export class InstanceLight {
    private readonly packed = new PackedTexture();
    /** Of the light: world centers, three floats each. NaN: not found yet. */
    private positions = new Float32Array(0);
    private hints = new Uint32Array(0);
    /** The instances that moved, in order, and what a batch of them takes and gives. */
    private moved = new Uint32Array(0);
    private readonly batch = {positions: new Float32Array(0), hints: new Uint32Array(0), packed: new Float32Array(0)};
    /** What positions were found for. */
    private version = NaN;
    private readonly matrixWorld = new three.Matrix4();

    constructor(private readonly mesh: InstancesMesh) {}

    get texture(): three.DataTexture {
        return this.packed.texture;
    }

    /** Finds the light of the instances that moved. */
    update(volume: Volume, options: BatchOptions): void {
        const {mesh} = this;
        const version = isBatched(mesh) ? versionOf(mesh) : mesh.instanceMatrix.version;
        if (version === this.version && this.matrixWorld.equals(mesh.matrixWorld)) return;
        this.resize(isBatched(mesh) ? mesh.maxInstanceCount : mesh.instanceMatrix.count);
        this.version = version;
        this.matrixWorld.copy(mesh.matrixWorld);
        const count = isBatched(mesh) ? this.findBatched(mesh) : this.findInstanced(mesh);
        if (count > 0) this.light(volume, options, count);
    }

    /** The next update finds the light of all. */
    forget(): void {
        this.version = NaN;
        this.positions.fill(NaN);
    }

    private resize(count: number): void {
        if (count === this.hints.length) return;
        this.packed.resize(count);
        this.positions = new Float32Array(3 * count).fill(NaN);
        this.hints = new Uint32Array(count).fill(kNone);
        this.moved = new Uint32Array(count);
    }

    /** Writes those of `moved`, whose number is `count`. */
    private light(volume: Volume, options: BatchOptions, count: number): void {
        const {batch, moved, positions, hints} = this;
        if (batch.hints.length < count) {
            const room = Math.min(hints.length, 2 * count);
            Object.assign(batch, {positions: new Float32Array(3 * room), hints: new Uint32Array(room),
                                  packed: new Float32Array(kPacked * room)});
        }
        for (let k = 0; k < count; ++k) {
            const i = moved[k];
            batch.hints[k] = hints[i];
            for (let axis = 0; axis < 3; ++axis) batch.positions[3 * k + axis] = positions[3 * i + axis];
        }
        volume.batch(batch.positions.subarray(0, 3 * count), {packed: batch.packed, hints: batch.hints}, options);
        for (let k = 0; k < count; ++k) {
            hints[moved[k]] = batch.hints[k];
            this.packed.set(moved[k], batch.packed, kPacked * k);
        }
        this.packed.upload(moved, count);
    }

    /** Lists the instances whose world center changed. */
    private findInstanced(mesh: three.InstancedMesh): number {
        const {x, y, z} = centerOfBounds(mesh.geometry);
        const m = mesh.instanceMatrix.array;
        const w = mesh.matrixWorld.elements;
        let count = 0;
        for (let i = 0, at = 0; i < this.hints.length; ++i, at += 16) {
            const px = m[at] * x + m[at + 4] * y + m[at + 8] * z + m[at + 12];
            const py = m[at + 1] * x + m[at + 5] * y + m[at + 9] * z + m[at + 13];
            const pz = m[at + 2] * x + m[at + 6] * y + m[at + 10] * z + m[at + 14];
            count = this.note(i, count, w[0] * px + w[4] * py + w[8] * pz + w[12],
                              w[1] * px + w[5] * py + w[9] * pz + w[13], w[2] * px + w[6] * py + w[10] * pz + w[14]);
        }
        return count;
    }

    /** The same, without instances that were deleted or not added yet. */
    private findBatched(mesh: three.BatchedMesh): number {
        const center = new three.Vector3();
        const matrix = new three.Matrix4();
        let count = 0;
        for (let i = 0; i < this.hints.length; ++i) {
            if (!placeBatched(mesh, i, center, matrix)) continue;
            center.applyMatrix4(matrix).applyMatrix4(mesh.matrixWorld);
            count = this.note(i, count, center.x, center.y, center.z);
        }
        return count;
    }

    /** Lists instance i if it moved; returns the number of those that did. */
    private note(i: number, count: number, x: number, y: number, z: number): number {
        const {positions} = this;
        const at = 3 * i;
        const [fx, fy, fz] = [Math.fround(x), Math.fround(y), Math.fround(z)];
        if (positions[at] === fx && positions[at + 1] === fy && positions[at + 2] === fz) return count;
        positions[at] = fx;
        positions[at + 1] = fy;
        positions[at + 2] = fz;
        this.moved[count] = i;
        return count + 1;
    }
}

const kSphere = new three.Sphere();

/** The center of an instance, local, and its matrix. False if it was deleted, or not added yet. */
function placeBatched(mesh: three.BatchedMesh, i: number, center: three.Vector3, matrix: three.Matrix4): boolean {
    let geometry = 0;
    try {
        geometry = mesh.getGeometryIdAt(i);
    } catch {
        return false;
    }
    center.copy(mesh.getBoundingSphereAt(geometry, kSphere)?.center ?? center.set(0, 0, 0));
    mesh.getMatrixAt(i, matrix);
    return true;
}

/** Of the matrices. NaN, which differs from itself, if this version of three.js keeps them in another place. */
function versionOf(mesh: three.BatchedMesh): number {
    return (mesh as unknown as {_matricesTexture?: three.Texture})._matricesTexture?.version ?? NaN;
}
