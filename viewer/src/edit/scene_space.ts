// SPDX-License-Identifier: Apache-2.0
// The static surfaces of a scene that stop light, as triangles in the world.
import * as three from 'three';

import {matricesOf} from '../scene/instances';
import type {SceneModel} from '../scene/scene_model';
import {contributes} from '../scene/scene_objects';
import type {SceneSpace} from './coverage';
import type {Position} from './groups';
import {TriangleTree} from './triangle_tree';

/** With more triangles the page would stand still for seconds. */
export const kMostTriangles = 1500000;

function isStatic(object: three.Object3D | null): boolean {
    for (let node = object; node !== null; node = node.parent) {
        if (node.userData.contribute_gi !== undefined) return contributes(node.userData.contribute_gi);
    }
    return true;
}

function meshesOf(root: three.Object3D): three.Mesh[] {
    const meshes: three.Mesh[] = [];
    root.traverse(object => {
        if (!(object instanceof three.Mesh) || !isStatic(object)) return;
        const materials = [object.material].flat() as three.Material[];
        if (materials.some(material => !material.transparent)) meshes.push(object);
    });
    return meshes;
}

const indexCountOf = ({geometry}: three.Mesh) => geometry.index?.count ?? geometry.getAttribute('position').count;

/** Null: there are too many triangles. */
export function spaceOf({root, box, lights}: SceneModel): SceneSpace | null {
    root.updateMatrixWorld(true);
    const meshes = meshesOf(root).flatMap(mesh => matricesOf(mesh).map(world => ({mesh, world})));
    const count = meshes.reduce((sum, {mesh}) => sum + Math.floor(indexCountOf(mesh) / 3), 0);
    if (count > kMostTriangles) return null;
    const corners = new Float32Array(9 * count);
    const isTwoSided = new Uint8Array(count);
    let at = 0;
    const p = new three.Vector3();
    for (const {mesh, world} of meshes) {
        const {index} = mesh.geometry;
        const positions = mesh.geometry.getAttribute('position');
        const isTurned = world.determinant() < 0;
        const sides = ([mesh.material].flat() as three.Material[])[0].side === three.DoubleSide ? 1 : 0;
        for (let i = 0; i + 2 < indexCountOf(mesh); i += 3, ++at) {
            isTwoSided[at] = sides;
            for (let k = 0; k < 3; ++k) {
                const corner = i + (isTurned ? 2 - k : k);
                p.fromBufferAttribute(positions, index?.getX(corner) ?? corner).applyMatrix4(world);
                p.toArray(corners, 9 * at + 3 * k);
            }
        }
    }
    const lamps = lights.filter(light => !(light instanceof three.DirectionalLight))
        .map(light => light.getWorldPosition(new three.Vector3()).toArray() as Position);
    return {tree: new TriangleTree(corners, isTwoSided), low: box.min.toArray(), high: box.max.toArray(), lamps};
}
