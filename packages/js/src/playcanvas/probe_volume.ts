// SPDX-License-Identifier: Apache-2.0
// Lights entities of PlayCanvas by the probes around them.
//
//     const probes = new ProbeVolume(read(buffer), app.scene);
//     probes.add(character);
//     each frame: probes.update();
import type {Entity, Material, MeshInstance, ModelComponent, RenderComponent, Scene, StandardMaterial} from 'playcanvas';

import {MovingLight, ObjectOptions} from '../moving_light.js';
import {kCoefficients} from '../sh.js';
import type {Volume} from '../volume.js';
import {ambientSh, SkyOfLight, skyOf} from './ambient_sh.js';

/** The name of the first vector of the array, which sets all. */
const kParameter = 'ambientSH[0]';

interface LitMesh {
    /** What the mesh had before it was lit. */
    material: Material;
    light: MovingLight;
}

/** A copy of a material that takes light from probes: that of all mesh instances with the same material. */
interface LitCopy {
    material: StandardMaterial;
    users: number;
}

export class ProbeVolume {
    private readonly meshes = new Map<MeshInstance, LitMesh>();
    private readonly copies = new Map<Material, LitCopy>();
    private sky = '';

    constructor(readonly volume: Volume, private readonly scene: Scene, private readonly options: ObjectOptions = {}) {}

    /**
     * Lights all mesh instances of an entity and of its children by the light at the centers of their bounds, in place of
     * the ambient light of the scene. They get copies of their materials, which `remove` takes away: change
     * `meshInstance.material`. Materials other than standard ones stay as they are.
     */
    add(entity: Entity): void {
        for (const mesh of meshInstancesOf(entity)) {
            const {material} = mesh;
            if (this.meshes.has(mesh) || !material || !isStandard(material)) continue;
            const copy = this.copies.get(material) ?? {material: litCopy(material), users: 0};
            ++copy.users;
            this.copies.set(material, copy);
            this.meshes.set(mesh, {material, light: new MovingLight()});
            mesh.material = copy.material;
        }
    }

    remove(entity: Entity): void {
        for (const mesh of meshInstancesOf(entity)) {
            const lit = this.meshes.get(mesh);
            if (!lit) continue;
            this.meshes.delete(mesh);
            mesh.deleteParameter(kParameter);
            mesh.material = lit.material;
            const copy = this.copies.get(lit.material)!;
            if (--copy.users > 0) continue;
            this.copies.delete(lit.material);
            copy.material.destroy();
        }
    }

    /** Finds the light of everything that moved; of all if the sky turned. */
    update(): void {
        const sky = JSON.stringify(this.skyOfScene());
        if (sky !== this.sky) this.forget();
        this.sky = sky;
        for (const [mesh, {light}] of this.meshes) {
            const {x, y, z} = mesh.aabb.center;
            if (!light.moveTo([x, y, z], this.volume, this.options)) continue;
            mesh.setParameter(kParameter, ambientSh(light.sh, skyOf(mesh.material as StandardMaterial, this.scene)));
        }
    }

    /** The same for everything: after the light of the volume changed (`Volume.setWeights`). */
    refresh(): void {
        this.forget();
        this.update();
    }

    private forget(): void {
        for (const {light} of this.meshes.values()) light.forget();
    }

    /** Of the materials that reflect it. */
    private skyOfScene(): SkyOfLight[] {
        return [...this.copies.values()].map(({material}) => skyOf(material, this.scene));
    }
}

function meshInstancesOf(entity: Entity): MeshInstance[] {
    const components = ['render', 'model'].flatMap(name =>
        entity.findComponents(name) as unknown as (RenderComponent | ModelComponent)[]);
    return components.flatMap(component => component.meshInstances ?? []);
}

function isStandard(material: Material): material is StandardMaterial {
    return 'ambientSH' in material && 'useSkybox' in material;
}

function litCopy(material: StandardMaterial): StandardMaterial {
    const copy = material.clone();
    // The shader reads the array if the material has one. PlayCanvas declares it for shaders alone.
    Object.assign(copy, {ambientSH: new Float32Array(kCoefficients)});
    copy.update();
    return copy;
}
