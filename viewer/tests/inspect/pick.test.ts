// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {pick} from '../../src/inspect/pick';
import type {SceneObject} from '../../src/scene/scene_objects';

const objectOf = (mesh: three.Mesh) => {
    mesh.updateMatrixWorld(true);
    return {name: 'object', node: mesh, meshes: [mesh]} as unknown as SceneObject;
};
const down = (x: number) => new three.Raycaster(new three.Vector3(x, 5, 0), new three.Vector3(0, -1, 0));

test('an instance is picked where it stands, with its own normal', () => {
    const tiles = new three.InstancedMesh(new three.PlaneGeometry(1, 1), new three.MeshBasicMaterial({side: three.DoubleSide}), 2);
    tiles.setMatrixAt(0, new three.Matrix4());
    tiles.setMatrixAt(1, new three.Matrix4().makeRotationX(-Math.PI / 2).setPosition(10, 0, 0));
    const picked = pick(down(10), [objectOf(tiles)])!;
    expect(picked.point.distanceTo(new three.Vector3(10, 0, 0))).toBeLessThan(1e-6);
    expect(picked.normal.distanceTo(new three.Vector3(0, 1, 0))).toBeLessThan(1e-6);
});

test('normals stay upright on surfaces that are scaled unevenly', () => {
    const slope = new three.Mesh(new three.PlaneGeometry(2, 2).rotateX(-Math.PI / 2).rotateZ(Math.PI / 4),
                                 new three.MeshBasicMaterial());
    slope.scale.set(3, 1, 1);
    const {normal} = pick(down(0), [objectOf(slope)])!;
    const along = new three.Vector3(3, 1, 0).normalize();  // of the surface
    expect(normal.dot(along)).toBeCloseTo(0, 6);
    expect(normal.length()).toBeCloseTo(1, 6);
});
