// SPDX-License-Identifier: Apache-2.0
// Keys that rotate, move and zoom the camera.
import * as three from 'three';

import type {View} from '../scene/first_view';

const kTurn = 0.1;  // radians
const kMove = 0.05;  // of the distance to the target
const kZoom = 0.9;
const kLeastTilt = 0.05;  // radians from straight up or down

const kArrows: Record<string, [right: number, up: number]> = {
    ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1],
};

/** The view after a key; null: the key is for something else. */
export function viewAfterKey({key, shiftKey, ctrlKey, metaKey, altKey}: KeyboardEvent, camera: three.Camera,
                             target: three.Vector3): View | null {
    if (ctrlKey || metaKey || altKey) return null;
    const center = target.clone();
    const offset = new three.Spherical().setFromVector3(camera.position.clone().sub(target));
    const arrow = kArrows[key];
    if (arrow !== undefined && shiftKey) {
        const [right, up] = [0, 1].map(column => new three.Vector3().setFromMatrixColumn(camera.matrix, column));
        const way = right.multiplyScalar(arrow[0]).addScaledVector(up, arrow[1]);
        center.addScaledVector(way, kMove * offset.radius);
    } else if (arrow !== undefined) {
        offset.theta += kTurn * arrow[0];
        offset.phi = Math.min(Math.PI - kLeastTilt, Math.max(kLeastTilt, offset.phi - kTurn * arrow[1]));
    } else if (key === '+' || key === '=') {
        offset.radius *= kZoom;
    } else if (key === '-') {
        offset.radius /= kZoom;
    } else {
        return null;
    }
    const eye = new three.Vector3().setFromSpherical(offset).add(center);
    return {eye: eye.toArray(), target: center.toArray()};
}
