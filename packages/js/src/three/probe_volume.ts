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
import {centerOfBounds} from './bounds.js';
import {InstanceLight, InstancesMesh} from './instances.js';
import {isLit, LightSource, litCopy} from './light_shader.js';

/** Options of all queries of the objects. */
export type ProbeVolumeOptions = Pick<QueryOptions, 'outside' | 'fadeDistance' | 'walls' | 'radius' | 'renderingLayers'>;

export type Mesh = three.Mesh<three.BufferGeometry, three.Material | three.Material[]>;

/** What a mesh had before it was lit. */
interface Before {
    material: three.Material | three.Material[];
}

/** A mesh with the light at its anchor, or at the center of its bounds. */
interface LitMesh extends Before {
    anchor: three.Object3D | undefined;
    light: Float32Array;
    position: three.Vector3;
    hint: number;
}

interface LitInstances extends Before {
    light: InstanceLight;
}

export class ProbeVolume {
    private readonly meshes = new Map<Mesh, LitMesh>();
    private readonly instances = new Map<InstancesMesh, LitInstances>();

    constructor(readonly volume: Volume, private readonly options: ProbeVolumeOptions = {}) {}

    /**
     * Lights all meshes of an object. Each gets its own copies of its materials, which `remove` takes away: change
     * `mesh.material`. Basic and other materials without light stay as they are. With an anchor, such as a bone or the
     * object itself, all meshes have the light at its position, so that the parts of a character match; instances have their own.
     */
    add(object: three.Object3D, anchor?: three.Object3D): void {
        object.traverse(child => {
            const mesh = child as Mesh;
            if (!mesh.isMesh || this.meshes.has(mesh)) return;
            if ('isInstancedMesh' in mesh || 'isBatchedMesh' in mesh) this.addInstances(child as InstancesMesh);
            else this.addMesh(mesh, anchor);
        });
    }

    remove(object: three.Object3D): void {
        object.traverse(child => {
            const mesh = child as Mesh;
            const before = this.meshes.get(mesh) ?? this.instances.get(child as InstancesMesh);
            if (!before) return;
            for (const material of [mesh.material].flat()) {
                if (![before.material].flat().includes(material)) material.dispose();
            }
            this.instances.get(child as InstancesMesh)?.light.texture.dispose();
            mesh.material = before.material;
            this.meshes.delete(mesh);
            this.instances.delete(child as InstancesMesh);
        });
    }

    /** Finds the light of everything that moved. World matrices must be those of the frame. */
    update(): void {
        for (const [mesh, lit] of this.meshes) {
            const position = lit.anchor ? kPosition.setFromMatrixPosition(lit.anchor.matrixWorld) : centerOf(mesh);
            if (!position.equals(lit.position)) this.lightMesh(lit, position);
        }
        for (const {light} of this.instances.values()) light.update(this.volume, this.options);
    }

    /** The same for everything: after the light of the volume changed (`Volume.setWeights`). */
    refresh(): void {
        for (const lit of this.meshes.values()) lit.position.set(NaN, NaN, NaN);
        for (const {light} of this.instances.values()) light.forget();
        this.update();
    }

    /** A copy of a material of a mesh that is lit from `source`, too. Materials without light stay as they are. */
    protected litMaterial(material: three.Material, source: LightSource, _mesh: Mesh): three.Material {
        return isLit(material) ? litCopy(material, source) : material;
    }

    private copies(mesh: Mesh, source: LightSource): three.Material | three.Material[] {
        const lit = [mesh.material].flat().map(material => this.litMaterial(material, source, mesh));
        return Array.isArray(mesh.material) ? lit : lit[0];
    }

    private addMesh(mesh: Mesh, anchor: three.Object3D | undefined): void {
        const light = new Float32Array(kPacked);
        const position = new three.Vector3(NaN, NaN, NaN);
        this.meshes.set(mesh, {material: mesh.material, anchor, light, hint: kNone, position});
        mesh.material = this.copies(mesh, {sh: light});
    }

    private addInstances(mesh: InstancesMesh): void {
        if (this.instances.has(mesh)) return;
        const light = new InstanceLight(mesh);
        this.instances.set(mesh, {material: mesh.material, light});
        mesh.material = this.copies(mesh, {texture: light.texture}) as three.Material;
    }

    private lightMesh(lit: LitMesh, position: three.Vector3): void {
        const light = this.volume.light([position.x, position.y, position.z], {...this.options, hint: lit.hint});
        lit.position.copy(position);
        lit.hint = light.cell;
        packSh(light.sh, 0, lit.light, 0);
    }
}

const kPosition = new three.Vector3();

function centerOf(mesh: Mesh): three.Vector3 {
    return kPosition.copy(centerOfBounds(mesh.geometry)).applyMatrix4(mesh.matrixWorld);
}
