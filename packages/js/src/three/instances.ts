// SPDX-License-Identifier: Apache-2.0
// The light of each instance of an `InstancedMesh` or a `BatchedMesh`, as a texture.
import * as three from 'three';

import type {BatchOptions} from '../batch.js';
import {kNone} from '../section_file.js';
import type {Volume} from '../volume.js';
import {centerOfBounds} from './bounds.js';
import {makePackedTexture, resizePackedTexture} from './packed_texture.js';

export type InstancesMesh = three.InstancedMesh | three.BatchedMesh;

const isBatched = (mesh: InstancesMesh): mesh is three.BatchedMesh => (mesh as three.BatchedMesh).isBatchedMesh === true;

export class InstanceLight {
    readonly texture = makePackedTexture();
    private packed = new Float32Array(0);
    private positions = new Float32Array(0);
    private hints = new Uint32Array(0);
    /** What the light was found for. */
    private version = NaN;
    private readonly matrixWorld = new three.Matrix4();

    constructor(private readonly mesh: InstancesMesh) {}

    /** Finds the light of all instances if any of them or the mesh moved. */
    update(volume: Volume, options: BatchOptions): void {
        const {mesh} = this;
        const version = isBatched(mesh) ? versionOf(mesh) : mesh.instanceMatrix.version;
        if (version === this.version && this.matrixWorld.equals(mesh.matrixWorld)) return;
        this.resize(isBatched(mesh) ? mesh.maxInstanceCount : mesh.instanceMatrix.count);
        this.findPositions();
        volume.batch(this.positions, {packed: this.packed, hints: this.hints}, options);
        this.texture.needsUpdate = true;
        this.version = version;
        this.matrixWorld.copy(mesh.matrixWorld);
    }

    /** The next update finds the light of all. */
    forget(): void {
        this.version = NaN;
    }

    private resize(count: number): void {
        if (count === this.hints.length) return;
        this.packed = resizePackedTexture(this.texture, count);
        this.positions = new Float32Array(3 * count);
        this.hints = new Uint32Array(count).fill(kNone);
    }

    private findPositions(): void {
        const {mesh, positions} = this;
        const center = new three.Vector3();
        const matrix = new three.Matrix4();
        for (let i = 0; i < this.hints.length; ++i) {
            const isThere = isBatched(mesh) ? findBatched(mesh, i, center, matrix) : findInstanced(mesh, i, center, matrix);
            if (!isThere) continue;
            center.applyMatrix4(matrix).applyMatrix4(mesh.matrixWorld).toArray(positions, 3 * i);
        }
    }
}

function findInstanced(mesh: three.InstancedMesh, i: number, center: three.Vector3, matrix: three.Matrix4): boolean {
    center.copy(centerOfBounds(mesh.geometry));
    matrix.fromArray(mesh.instanceMatrix.array, 16 * i);
    return true;
}

const kSphere = new three.Sphere();

/** False if the instance was deleted, or not added yet. */
function findBatched(mesh: three.BatchedMesh, i: number, center: three.Vector3, matrix: three.Matrix4): boolean {
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
