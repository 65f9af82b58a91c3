// SPDX-License-Identifier: Apache-2.0
// Where the ball lies when a scene opens: on a surface that the camera sees, in free space.
import * as three from 'three';

import type {SceneRays} from '../scene/scene_rays';

export interface BallPlace {
    place: three.Vector3;
    radius: number;
}

/** Above the surface, so that rounding puts no part of the ball into it. */
const kLift = 1.02;
/** Of the radius, as far as nothing else may be near. */
const kRoom = 0.8;
/** Half of the height of the view is 1: a smaller ball is hard to see, a larger one hides the scene. */
const kSmallest = 0.03;
const kLargest = 0.25;

/** Places of the picture, -1 to 1, those in the middle and a little below it first. */
const kLooks = [-0.8, -0.6, -0.4, -0.2, 0, 0.2, 0.4].flatMap(
    y => [-0.6, -0.4, -0.2, 0, 0.2, 0.4, 0.6].map(x => ({x, y})))
    .sort((a, b) => Math.hypot(a.x, a.y + 0.3) - Math.hypot(b.x, b.y + 0.3) || a.x - b.x);

/** The first free place: on floors rather than walls, with the radius that is asked for rather than a smaller one.
 * `isKnown` says whether there is light at a place. Null: there is none. */
export function placeBall(camera: three.PerspectiveCamera, rays: SceneRays, radius: number,
                          isKnown: (place: three.Vector3) => boolean): BallPlace | null {
    camera.updateMatrixWorld();
    const hits = new Map<object, ReturnType<SceneRays['hit']>>();
    const hitOf = (look: {x: number; y: number}) => {
        if (!hits.has(look)) hits.set(look, rays.hit(rayAt(camera, look.x, look.y)));
        return hits.get(look)!;
    };
    for (const size of [radius, radius / 2, radius / 4]) {
        for (const least of [0.8, -1]) {
            for (const look of kLooks) {
                const hit = hitOf(look);
                if (hit === null || hit.isBack || hit.normal.y < least) continue;
                const place = hit.point.clone().addScaledVector(hit.normal, kLift * size);
                if (isSeen(camera, place, size) && isFree(camera, rays, place, hit.normal, size) && isKnown(place)) {
                    return {place, radius: size};
                }
            }
        }
    }
    return null;
}

function rayAt(camera: three.Camera, x: number, y: number): three.Ray {
    const caster = new three.Raycaster();
    caster.setFromCamera(new three.Vector2(x, y), camera);
    return caster.ray;
}

/** As a whole in the picture, neither tiny nor huge. */
function isSeen(camera: three.PerspectiveCamera, place: three.Vector3, radius: number): boolean {
    const size = radius / (place.distanceTo(camera.position) * Math.tan(three.MathUtils.degToRad(camera.fov / 2)));
    const {x, y, z} = place.clone().project(camera);
    return size > kSmallest && size < kLargest && z < 1 && Math.abs(y) + size < 0.95 &&
        Math.abs(x) + size / camera.aspect < 0.95;
}

/** Touches what it lies on only, has room about it, is not within anything, and nothing is before it. */
function isFree(camera: three.Camera, rays: SceneRays, place: three.Vector3, normal: three.Vector3, radius: number): boolean {
    if (rays.clearance(place, radius) < radius) return false;
    const above = place.clone().addScaledVector(normal, kRoom * radius);
    if (rays.clearance(above, (1 + kRoom) * radius) < (1 + kRoom) * radius) return false;
    const up = rays.hit(new three.Ray(place, new three.Vector3(0, 1, 0)));
    if (up !== null && up.isBack) return false;
    const way = place.clone().sub(camera.position);
    const between = rays.hit(new three.Ray(camera.position.clone(), way.clone().normalize()));
    return between === null || between.distance > way.length() - radius;
}
