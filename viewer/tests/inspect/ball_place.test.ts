// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {placeBall} from '../../src/inspect/ball_place';
import {SceneRays} from '../../src/scene/scene_rays';

const kRadius = 0.2;

/** A floor of 20 m at y = 0, and boxes: center, size. */
function sceneOf(...boxes: [number[], number[]][]): three.Group {
    const root = new three.Group();
    const floor = new three.Mesh(new three.PlaneGeometry(20, 20));
    floor.rotation.x = -Math.PI / 2;
    root.add(floor);
    for (const [center, size] of boxes) {
        const box = new three.Mesh(new three.BoxGeometry(...size as [number, number, number]));
        box.position.fromArray(center);
        root.add(box);
    }
    root.updateMatrixWorld(true);
    return root;
}

function cameraAt(eye: number[], target: number[]): three.PerspectiveCamera {
    const camera = new three.PerspectiveCamera(50, 1.5, 0.05, 100);
    camera.position.fromArray(eye);
    camera.lookAt(new three.Vector3().fromArray(target));
    return camera;
}

const everywhere = () => true;

test('the ball lies on the floor that the camera sees', () => {
    const found = placeBall(cameraAt([0, 2, 5], [0, 0, 0]), new SceneRays(sceneOf()), kRadius, everywhere)!;
    expect(found.radius).toBe(kRadius);
    expect(found.place.y).toBeGreaterThan(kRadius);
    expect(found.place.y).toBeLessThan(1.1 * kRadius);
});

test('it is never in, nor behind, what stands on the floor', () => {
    const camera = cameraAt([0, 2, 5], [0, 0, 0]);
    const first = placeBall(camera, new SceneRays(sceneOf()), kRadius, everywhere)!.place;
    const root = sceneOf([[first.x, 0.3, first.z], [1, 0.6, 1]]);  // where the ball was
    const rays = new SceneRays(root);
    const {place, radius} = placeBall(camera, rays, kRadius, everywhere)!;
    expect(rays.clearance(place, 1)).toBeGreaterThanOrEqual(radius);
    const away = new three.Raycaster(camera.position, place.clone().sub(camera.position).normalize());
    expect(away.intersectObject(root)[0].distance).toBeGreaterThan(place.distanceTo(camera.position) - radius);
});

test('where there is no room for it, it is smaller', () => {
    const camera = cameraAt([0, 0.18, 1], [0, 0.1, 0]);
    const ceiling: [number[], number[]] = [[0, 1.25, 0], [20, 2, 20]];  // 0.25 m above the floor
    expect(placeBall(camera, new SceneRays(sceneOf(ceiling)), kRadius, everywhere)!.radius).toBeLessThan(kRadius);
});

test('without a surface in view, or light there, it has no place', () => {
    const rays = new SceneRays(sceneOf());
    expect(placeBall(cameraAt([0, 2, 5], [0, 9, 0]), rays, kRadius, everywhere)).toBeNull();
    expect(placeBall(cameraAt([0, 2, 5], [0, 0, 0]), rays, kRadius, () => false)).toBeNull();
});

test('a ray from inside a box hits the back of its side', () => {
    const rays = new SceneRays(sceneOf([[0, 1, 0], [2, 2, 2]]));
    const inside = rays.hit(new three.Ray(new three.Vector3(0, 1, 0), new three.Vector3(1, 0, 0)))!;
    expect(inside).toMatchObject({isBack: true, distance: 1});
    const outside = rays.hit(new three.Ray(new three.Vector3(4, 1, 0), new three.Vector3(-1, 0, 0)))!;
    expect(outside).toMatchObject({isBack: false, distance: 3});
    expect(outside.normal.x).toBe(1);
    expect(rays.clearance(new three.Vector3(3, 1, 0), 9)).toBeCloseTo(1, 6);  // the floor and the box
});
