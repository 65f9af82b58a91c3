// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {firstView, kFov} from '../../src/scene/first_view';

const kBox = new three.Box3(new three.Vector3(-1, 0, -1), new three.Vector3(1, 2, 1));

/** Looks down from 30 m above the ground. */
function placed<C extends three.Camera>(camera: C): C {
    camera.position.set(0, 30, 0);
    camera.rotation.x = -Math.PI / 2;
    camera.updateMatrixWorld(true);
    return camera;
}

test('a scene without a camera has no view', () => {
    expect(firstView(undefined, kBox)).toBeNull();
});

test('a perspective camera stays where it stands', () => {
    const view = firstView(placed(new three.PerspectiveCamera(40)), kBox)!;
    expect(view.eye).toEqual([0, 30, 0]);
    expect(view.target[1]).toBeCloseTo(1);
});

test('an orthographic camera becomes one that sees the same height', () => {
    const view = firstView(placed(new three.OrthographicCamera(-9, 9, 2, -2)), kBox)!;
    const page = new three.PerspectiveCamera(kFov, 1);
    page.position.fromArray(view.eye);
    page.rotation.x = -Math.PI / 2;
    page.updateMatrixWorld(true);
    // 2 m up in the picture, at the height of the target.
    const edge = new three.Vector3().fromArray(view.target).add(new three.Vector3(0, 0, -2)).project(page);
    expect(edge.x).toBeCloseTo(0);
    expect(edge.y).toBeCloseTo(1);
});
