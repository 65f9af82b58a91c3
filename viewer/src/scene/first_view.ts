// SPDX-License-Identifier: Apache-2.0
// The view that a scene opens with: that of its first camera.
import * as three from 'three';

/** Vertical field of view of the page's camera, degrees. */
export const kFov = 50;

export interface View {
    eye: number[];
    target: number[];
}

/** The page's camera is perspective: for an orthographic one it stands where it sees the same height. */
export function firstView(camera: three.Camera | undefined, box: three.Box3): View | null {
    if (camera === undefined) return null;
    const eye = camera.getWorldPosition(new three.Vector3());
    const direction = camera.getWorldDirection(new three.Vector3());
    const distance = box.getCenter(new three.Vector3()).sub(eye).dot(direction);
    const target = eye.clone().addScaledVector(direction, Math.max(1, distance));
    if (camera instanceof three.OrthographicCamera) {
        const back = camera.top / Math.tan(three.MathUtils.degToRad(kFov / 2));
        eye.copy(target).addScaledVector(direction, -back);
    }
    return {eye: eye.toArray(), target: target.toArray()};
}
