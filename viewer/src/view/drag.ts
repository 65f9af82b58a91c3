// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';

import type {Stage} from './stage';

/** A plane that is seen flatter than this is of no use to drag on: sine of the angle. */
const kFlat = 0.2;
/** Farther away than this, times the first distance, a step of the pointer is a leap. */
const kFarthest = 6;

/** Moves a place with the pointer: on its level, or in the plane that faces the camera where the level is seen from
 * the side; or only up and down. */
export class Drag {
    private readonly plane = new three.Plane();
    private readonly grip = new three.Vector3();
    private readonly start: three.Vector3;
    private readonly distance: number;

    constructor(private readonly stage: Stage, at: three.Vector3, x: number, y: number, private readonly isUpright: boolean) {
        this.start = at.clone();
        this.distance = at.distanceTo(stage.camera.position);
        const {direction} = stage.rayAt(x, y).ray;
        const facing = stage.camera.getWorldDirection(new three.Vector3());
        const isLevel = !isUpright && Math.abs(direction.y) > kFlat;
        this.plane.setFromNormalAndCoplanarPoint(isLevel ? new three.Vector3(0, 1, 0) : facing, at);
        this.grip.copy(at).sub(this.hit(x, y) ?? at);
    }

    /** Where the place is now, or null where the plane is not seen. */
    to(x: number, y: number): three.Vector3 | null {
        const hit = this.hit(x, y);
        if (hit === null || hit.distanceTo(this.stage.camera.position) > kFarthest * this.distance) return null;
        hit.add(this.grip);
        return this.isUpright ? this.start.clone().setY(hit.y) : hit;
    }

    private hit(x: number, y: number): three.Vector3 | null {
        return this.stage.rayAt(x, y).ray.intersectPlane(this.plane, new three.Vector3());
    }
}
