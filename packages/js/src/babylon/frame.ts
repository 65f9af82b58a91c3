// SPDX-License-Identifier: Apache-2.0
// Babylon's scenes are left-handed unless `useRightHandedSystem` is set. Its glTF loader mirrors x then, and so do we.
import {mirrorSh} from '../polynomial_sh.js';
import type {Vector} from '../sh.js';

/** What is used of a scene. */
export interface Handedness {
    readonly useRightHandedSystem: boolean;
}

/** A position of a scene in the volume. */
export function positionInVolume(position: {x: number; y: number; z: number}, scene: Handedness): [number, number, number] {
    return [scene.useRightHandedSystem ? position.x : -position.x, position.y, position.z];
}

/** Light of the volume for normals of a scene. */
export function shInScene(sh: Vector, scene: Handedness): Float32Array {
    const inScene = Float32Array.from(sh);
    if (!scene.useRightHandedSystem) mirrorSh(inScene, 'x');
    return inScene;
}
