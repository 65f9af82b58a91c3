// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';

import {matricesOf} from '../scene/instances';
import type {SceneObject} from '../scene/scene_objects';

export interface Picked {
    object: SceneObject;
    distance: number;
    point: three.Vector3;
    /** Of the surface, towards the eye. */
    normal: three.Vector3;
}

/** What a ray sees first of objects, or null. */
export function pick(caster: three.Raycaster, objects: readonly SceneObject[]): Picked | null {
    const owners = new Map(objects.flatMap(object => object.meshes.map(mesh => [mesh as three.Object3D, object] as const)));
    const [hit] = caster.intersectObjects([...owners.keys()], false);
    if (hit === undefined) return null;
    const world = matricesOf(hit.object as three.Mesh)[hit.instanceId ?? 0];
    const normal = hit.face!.normal.clone().applyNormalMatrix(new three.Matrix3().getNormalMatrix(world)).normalize();
    if (normal.dot(caster.ray.direction) > 0) normal.negate();
    return {object: owners.get(hit.object)!, distance: hit.distance, point: hit.point, normal};
}
