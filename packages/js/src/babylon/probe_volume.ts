// SPDX-License-Identifier: Apache-2.0
// Lights meshes of Babylon by the probes around them.
//
//     const probes = new ProbeVolume(read(buffer));
//     probes.add(character);
//     each frame: probes.update();
import type {Material} from '@babylonjs/core/Materials/material.js';
import type {AbstractMesh} from '@babylonjs/core/Meshes/abstractMesh.js';
import type {Node} from '@babylonjs/core/node.js';

import {MovingLight, ObjectOptions} from '../moving_light.js';
import {packSh} from '../sh.js';
import type {Volume} from '../volume.js';
import {positionInVolume, shInScene} from './frame.js';
import {ProbePlugin} from './probe_plugin.js';

interface LitMesh {
    /** What the mesh had before it was lit. */
    material: Material;
    light: MovingLight;
    plugins: ProbePlugin[];
}

export class ProbeVolume {
    private readonly meshes = new Map<AbstractMesh, LitMesh>();

    constructor(readonly volume: Volume, private readonly options: ObjectOptions = {}) {}

    /**
     * Lights a node and all meshes below it by the light at the centers of their bounds, in addition to the light of the
     * scene. Each mesh gets its own copy of its material, which `remove` takes away: change `mesh.material`. Materials
     * other than PBR and standard ones stay as they are. Instances of a mesh have its light.
     */
    add(node: Node): void {
        for (const mesh of meshesOf(node)) {
            const {material} = mesh;
            if (this.meshes.has(mesh) || !material || mesh.isAnInstance) continue;
            const copy = cloneOf(material);
            const plugins = partsOf(copy).filter(isLit).map(part => new ProbePlugin(part));
            if (plugins.length === 0) {
                disposeCopy(copy);
                continue;
            }
            this.meshes.set(mesh, {material, light: new MovingLight(), plugins});
            mesh.material = copy;
        }
    }

    remove(node: Node): void {
        for (const mesh of meshesOf(node)) {
            const lit = this.meshes.get(mesh);
            if (!lit) continue;
            this.meshes.delete(mesh);
            const copy = mesh.material;
            mesh.material = lit.material;
            if (copy) disposeCopy(copy);
        }
    }

    /** Finds the light of everything that moved. World matrices must be those of the frame. */
    update(): void {
        for (const [mesh, {light, plugins}] of this.meshes) {
            const scene = mesh.getScene();
            const center = mesh.getBoundingInfo().boundingBox.centerWorld;
            if (!light.moveTo(positionInVolume(center, scene), this.volume, this.options)) continue;
            const sh = shInScene(light.sh, scene);
            for (const plugin of plugins) packSh(sh, 0, plugin.packed, 0);
        }
    }

    /** The same for everything: after the light of the volume changed (`Volume.setWeights`). */
    refresh(): void {
        for (const {light} of this.meshes.values()) light.forget();
        this.update();
    }
}

function meshesOf(node: Node): AbstractMesh[] {
    const below = node.getChildMeshes();
    return 'getBoundingInfo' in node ? [node as AbstractMesh, ...below] : below;
}

type Several = Material & {subMaterials: (Material | null)[]};

const isSeveral = (material: Material): material is Several => 'subMaterials' in material;

function partsOf(material: Material): Material[] {
    return isSeveral(material) ? material.subMaterials.filter(part => part !== null) : [material];
}

function isLit(material: Material): boolean {
    return ['StandardMaterial', 'PBRMaterial', 'PBRMetallicRoughnessMaterial', 'PBRSpecularGlossinessMaterial']
        .includes(material.getClassName());
}

function cloneOf(material: Material): Material {
    const name = `${material.name} (probes)`;
    // With the materials that it joins.
    const clone = isSeveral(material) ? (material as unknown as {clone(name: string, children: boolean): Material}).clone(name, true)
                                      : material.clone(name);
    return clone ?? material;
}

/** Textures belong to the material of before, too. */
function disposeCopy(copy: Material): void {
    for (const part of partsOf(copy)) part.dispose(false, false);
    if (isSeveral(copy)) copy.dispose(false, false);
}
