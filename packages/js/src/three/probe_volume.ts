// SPDX-License-Identifier: Apache-2.0
// Lights objects of three.js by the probes around them.
//
//     const probes = new ProbeVolume(read(buffer));
//     probes.add(character);
//     each frame: probes.update();
import * as three from 'three';

import type {QueryOptions} from '../query_options.js';
import {kNone} from '../section_file.js';
import {kPacked, packSh} from '../sh.js';
import type {Volume} from '../volume.js';
import {isLit, litCopy} from './light_shader.js';

/** A row of the texture of instances has at most 7 · 512 texels. */
const kInstancesInRow = 512;

/** Options of all queries of the objects. */
export type ProbeVolumeOptions = Pick<QueryOptions, 'outside' | 'fadeDistance' | 'walls' | 'radius' | 'renderingLayers'>;

type Mesh = three.Mesh<three.BufferGeometry, three.Material | three.Material[]>;

/** What a mesh had before it was lit. */
interface Before {
    material: three.Material | three.Material[];
}

/** A mesh that follows the light at the center of its bounds. */
interface LitMesh extends Before {
    light: Float32Array;
    position: three.Vector3;
    hint: number;
}

/** Instances, each of which has the light at its own center. */
interface LitInstances extends Before {
    /** Seven texels each. */
    texture: three.DataTexture;
    light: Float32Array;
    positions: Float32Array;
    hints: Uint32Array;
    /** Of the matrices that they were lit at. */
    version: number;
    matrixWorld: three.Matrix4;
}

export class ProbeVolume {
    private readonly meshes = new Map<Mesh, LitMesh>();
    private readonly instances = new Map<three.InstancedMesh, LitInstances>();

    constructor(readonly volume: Volume, private readonly options: ProbeVolumeOptions = {}) {}

    /**
     * Lights all meshes of an object. Each gets its own copies of its materials, which `remove` takes away: change
     * `mesh.material`. Basic and other materials without light stay as they are.
     */
    add(object: three.Object3D): void {
        object.traverse(child => {
            const mesh = child as Mesh;
            if (!mesh.isMesh || this.meshes.has(mesh)) return;
            const instances = child as three.InstancedMesh;
            if (instances.isInstancedMesh) this.addInstances(instances);
            else this.addMesh(mesh);
        });
    }

    remove(object: three.Object3D): void {
        object.traverse(child => {
            const mesh = child as Mesh;
            const before = this.meshes.get(mesh) ?? this.instances.get(mesh as three.InstancedMesh);
            if (!before) return;
            for (const material of [mesh.material].flat()) {
                if (![before.material].flat().includes(material)) material.dispose();
            }
            this.instances.get(mesh as three.InstancedMesh)?.texture.dispose();
            mesh.material = before.material;
            this.meshes.delete(mesh);
            this.instances.delete(mesh as three.InstancedMesh);
        });
    }

    /** Finds the light of everything that moved. World matrices must be those of the frame. */
    update(): void {
        for (const [mesh, lit] of this.meshes) {
            const position = centerOf(mesh);
            if (!position.equals(lit.position)) this.lightMesh(lit, position);
        }
        for (const [mesh, lit] of this.instances) {
            const isMoved = lit.version !== mesh.instanceMatrix.version || !lit.matrixWorld.equals(mesh.matrixWorld);
            if (isMoved) this.lightInstances(mesh, lit);
        }
    }

    /** The same for everything: after the light of the volume changed (`Volume.setWeights`). */
    refresh(): void {
        for (const lit of this.meshes.values()) lit.position.set(NaN, NaN, NaN);
        for (const lit of this.instances.values()) lit.version = -1;
        this.update();
    }

    private addMesh(mesh: Mesh): void {
        const light = new Float32Array(kPacked);
        this.meshes.set(mesh, {material: mesh.material, light, hint: kNone, position: new three.Vector3(NaN, NaN, NaN)});
        mesh.material = copies(mesh.material, material => litCopy(material, {sh: light}));
    }

    private addInstances(mesh: three.InstancedMesh): void {
        if (this.instances.has(mesh)) return;
        const count = mesh.instanceMatrix.count;
        const inRow = Math.max(1, Math.min(count, kInstancesInRow));
        const rows = Math.max(1, Math.ceil(count / inRow));
        const light = new Float32Array(kPacked * inRow * rows);
        const texture = new three.DataTexture(light, 7 * inRow, rows, three.RGBAFormat, three.FloatType);
        this.instances.set(mesh, {material: mesh.material, texture, light, positions: new Float32Array(3 * count),
                                  hints: new Uint32Array(count).fill(kNone), version: -1,
                                  matrixWorld: new three.Matrix4()});
        mesh.material = copies(mesh.material, material => litCopy(material, {texture}));
    }

    private lightMesh(lit: LitMesh, position: three.Vector3): void {
        const light = this.volume.light([position.x, position.y, position.z], {...this.options, hint: lit.hint});
        lit.position.copy(position);
        lit.hint = light.cell;
        packSh(light.sh, 0, lit.light, 0);
    }

    private lightInstances(mesh: three.InstancedMesh, lit: LitInstances): void {
        const center = localCenter(mesh.geometry);
        const matrix = new three.Matrix4();
        const position = new three.Vector3();
        for (let i = 0; i < lit.hints.length; ++i) {
            matrix.fromArray(mesh.instanceMatrix.array, 16 * i);
            position.copy(center).applyMatrix4(matrix).applyMatrix4(mesh.matrixWorld).toArray(lit.positions, 3 * i);
        }
        this.volume.batch(lit.positions, {packed: lit.light, hints: lit.hints}, this.options);
        lit.texture.needsUpdate = true;
        lit.version = mesh.instanceMatrix.version;
        lit.matrixWorld.copy(mesh.matrixWorld);
    }
}

function copies(material: three.Material | three.Material[], copy: (material: three.Material) => three.Material) {
    const lit = [material].flat().map(each => isLit(each) ? copy(each) : each);
    return Array.isArray(material) ? lit : lit[0];
}

/** The center of the bounds of a geometry. */
function localCenter(geometry: three.BufferGeometry): three.Vector3 {
    if (!geometry.boundingSphere) geometry.computeBoundingSphere();
    return geometry.boundingSphere!.center;
}

function centerOf(mesh: Mesh): three.Vector3 {
    return localCenter(mesh.geometry).clone().applyMatrix4(mesh.matrixWorld);
}
