// SPDX-License-Identifier: Apache-2.0
import type {Volume} from 'tetralight';
import * as three from 'three';
import type {GLTF} from 'three/addons/loaders/GLTFLoader.js';
import {expect, test} from 'vitest';

import {lightGrid, ObjectLight} from '../../src/scene/object_light';
import {boxOf, moveCenter, objectsOf, putBack} from '../../src/scene/scene_objects';

/** As GLTFLoader gives it: nodes with `extras` as their user data, those of index i have a mesh where `nodes` says so. */
function gltfOf(build: (add: (name: string, extras?: object, parent?: three.Object3D, hasMesh?: boolean) => three.Object3D) => void): GLTF {
    const scene = new three.Group();
    const nodes: {name: string; mesh?: number}[] = [];
    const associations = new Map<object, {nodes: number}>();
    build((name, extras = {}, parent = scene, hasMesh = true) => {
        const node = hasMesh ? new three.Mesh(new three.BoxGeometry(1, 1, 1)) : new three.Object3D();
        node.userData = extras;
        associations.set(node, {nodes: nodes.length});
        nodes.push({name, ...hasMesh ? {mesh: 0} : {}});
        parent.add(node);
        return node;
    });
    return {scene, parser: {json: {nodes}, associations}} as unknown as GLTF;
}

test('children inherit what moves and what has a proxy volume', () => {
    const objects = objectsOf(gltfOf(add => {
        add('wall');
        const movers = add('movers', {contribute_gi: false, light_probes: 'proxy_volume'}, undefined, false);
        add('beam', {}, movers);
        add('crate', {light_probes: 'blend'}, movers);
        add('rock', {contribute_gi: true}, movers);
        add('blender', {contribute_gi: 0});
    }));
    expect(objects.map(({name, isStatic, hasProxyVolume}) => [name, isStatic, hasProxyVolume])).toEqual([
        ['wall', true, false], ['beam', false, true], ['crate', false, false], ['rock', true, false], ['blender', false, false]]);
});

test('a mesh of several primitives is one object', () => {
    const gltf = gltfOf(add => {
        const group = add('car', {}, undefined, true);
        group.add(new three.Mesh(new three.BoxGeometry(1, 1, 1)));
    });
    expect(objectsOf(gltf).map(({name, meshes}) => [name, meshes.length])).toEqual([['car', 2]]);
});

test('an object is moved by its center, whatever its parent, and put back', () => {
    const [object] = objectsOf(gltfOf(add => {
        const parent = add('parent', {}, undefined, false);
        parent.position.set(1, 2, 3);
        parent.scale.setScalar(2);
        parent.rotation.y = Math.PI / 2;
        add('crate', {contribute_gi: false}, parent).position.set(0.5, 0, 0);
    }));
    const center = () => boxOf(object).getCenter(new three.Vector3()).toArray();
    const start = center();
    moveCenter(object, new three.Vector3(-4, 1, 2));
    center().forEach((x, axis) => expect(x).toBeCloseTo([-4, 1, 2][axis], 6));
    putBack(object);
    center().forEach((x, axis) => expect(x).toBeCloseTo(start[axis], 6));
});

test('the light of an object is that at its center, or of a grid over its box', () => {
    const [small, large] = objectsOf(gltfOf(add => {
        add('small', {contribute_gi: false}).position.set(1, 2, 3);
        add('large', {contribute_gi: false, light_probes: 'proxy_volume'}).scale.set(6, 1, 1);
    }));
    const asked: number[][] = [];
    const volume = {irradiance: new Float32Array(27), batch: (positions: Float32Array) => { asked.push([...positions]); }};
    new ObjectLight(small).place(volume as unknown as Volume);
    expect(asked.length).toBe(1);
    asked[0].forEach((x, axis) => expect(x).toBeCloseTo([1, 2, 3][axis], 6));
    const grid = lightGrid(large);
    expect(grid.low.toArray()).toEqual([-3, -0.5, -0.5]);
    expect(grid.resolution).toEqual([13, 3, 3]);
});

test('the box of an object is around all its instances', () => {
    const instanced = new three.InstancedMesh(new three.BoxGeometry(1, 1, 1), new three.Material(), 2);
    instanced.setMatrixAt(0, new three.Matrix4());
    instanced.setMatrixAt(1, new three.Matrix4().makeTranslation(10, 0, 0));
    const [object] = objectsOf(gltfOf(add => {
        add('pillars').add(instanced);
    }));
    object.node.scale.setScalar(2);
    const {min, max} = boxOf(object);
    expect([...min, ...max]).toEqual([-1, -1, -1, 21, 1, 1]);
});
