// SPDX-License-Identifier: Apache-2.0
// The objects of a glTF scene that one can select: the nodes that have meshes.
import * as three from 'three';
import type {GLTF} from 'three/addons/loaders/GLTFLoader.js';

import {boxIn, matricesOf} from './instances';

export interface SceneObject {
    name: string;
    node: three.Object3D;
    meshes: three.Mesh[];
    /** Part of a bake, so that it cannot move here: docs/scenes.md, `contribute_gi`. */
    isStatic: boolean;
    /** Lit by a grid of light around it, not by the light at its center. */
    hasProxyVolume: boolean;
    /** Where the file has the node, to put it back. */
    home: three.Vector3;
}

interface Words {
    contribute_gi?: unknown;
    light_probes?: unknown;
}

export function objectsOf({scene, parser}: GLTF): SceneObject[] {
    const {json, associations} = parser as unknown as {
        json: {nodes?: {mesh?: number; name?: string}[]};
        associations: Map<object, {nodes?: number} | undefined>;
    };
    const objects: SceneObject[] = [];
    const visit = (node: three.Object3D, isStatic: boolean, hasProxyVolume: boolean, owner: SceneObject | null) => {
        const index = associations.get(node)?.nodes;
        if (index !== undefined) {
            const words = node.userData as Words;
            if (words.contribute_gi !== undefined) isStatic = contributes(words.contribute_gi);
            if (words.light_probes !== undefined) hasProxyVolume = words.light_probes === 'proxy_volume';
            owner = null;
            if (json.nodes?.[index]?.mesh !== undefined) {
                const name = json.nodes[index].name || `node ${index}`;
                owner = {name, node, meshes: [], isStatic, hasProxyVolume: hasProxyVolume && !isStatic,
                         home: node.position.clone()};
                objects.push(owner);
            }
        }
        if (node instanceof three.Mesh) owner?.meshes.push(node);
        for (const child of node.children) visit(child, isStatic, hasProxyVolume, owner);
    };
    visit(scene, true, false, null);
    return objects.filter(({meshes}) => meshes.length > 0);
}

/** Of `contribute_gi`: Blender 3 writes numbers for booleans. */
export const contributes = (word: unknown) => word !== false && word !== 0;

/** The box of an object in the world, with all its instances, where it is now. */
export function boxOf({node, meshes}: SceneObject): three.Box3 {
    node.updateWorldMatrix(true, true);
    const box = new three.Box3();
    for (const mesh of meshes) {
        for (const world of matricesOf(mesh)) box.union(boxIn(mesh.geometry, world));
    }
    return box;
}

/** Moves an object so that the center of its box is at a place of the world. */
export function moveCenter(object: SceneObject, center: three.Vector3): void {
    const {node} = object;
    const way = center.clone().sub(boxOf(object).getCenter(new three.Vector3()));
    const place = node.getWorldPosition(new three.Vector3()).add(way);
    node.position.copy(node.parent === null ? place : node.parent.worldToLocal(place));
    node.updateWorldMatrix(false, true);
}

export function putBack({node, home}: SceneObject): void {
    node.position.copy(home);
    node.updateWorldMatrix(true, true);
}
