// SPDX-License-Identifier: Apache-2.0
// What the tests run in the browser, as `window.page`: squares that face the camera, and their light in floats.
import * as three from 'three';

import {read} from '../src/index.js';
import {ProbeVolume, toLightProbeGrid} from '../src/three/index.js';

export type Kind = 'standard' | 'physical' | 'lambert' | 'phong';

const kAlbedo = 0.5;
const kSize = 8;  // pixels of a picture

const renderer = new three.WebGLRenderer();
const target = new three.WebGLRenderTarget(kSize, kSize, {type: three.FloatType});

function makeMaterial(kind: Kind): three.Material {
    const color = new three.Color(kAlbedo, kAlbedo, kAlbedo);
    switch (kind) {
        case 'standard': return new three.MeshStandardMaterial({color, roughness: 1, metalness: 0});
        case 'physical': return new three.MeshPhysicalMaterial({color, roughness: 1, metalness: 0, specularIntensity: 0});
        case 'lambert': return new three.MeshLambertMaterial({color});
        case 'phong': return new three.MeshPhongMaterial({color, specular: 0});
    }
}

/** A camera that sees nothing but the middle of the square at a position, along its normal. */
function cameraAt(position: three.Vector3, normal: three.Vector3): three.Camera {
    const camera = new three.OrthographicCamera(-0.01, 0.01, 0.01, -0.01, 0.01, 2);
    camera.position.copy(position).add(normal);
    camera.up.set(normal.z, normal.x, normal.y);
    camera.lookAt(position);
    return camera;
}

/** The color in the middle of the picture, linear. */
function colorOf(scene: three.Scene, camera: three.Camera): number[] {
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    const pixels = new Float32Array(4 * kSize * kSize);
    renderer.readRenderTargetPixels(target, 0, 0, kSize, kSize, pixels);
    return [...pixels.subarray(4 * (kSize * kSize / 2 + kSize / 2)).subarray(0, 3)];
}

const vector = (v: readonly number[]) => new three.Vector3(...v as [number, number, number]);

interface Square {
    position: readonly number[];
    normal: readonly number[];
}

function placeOf({position, normal}: Square): three.Matrix4 {
    const turn = new three.Quaternion().setFromUnitVectors(new three.Vector3(0, 0, 1), vector(normal));
    return new three.Matrix4().compose(vector(position), turn, new three.Vector3(1, 1, 1));
}

const kGeometry = new three.PlaneGeometry(1, 1);

/** One square of each place, each in a scene with all of them; they share one material. */
function shadeMeshes(probes: ProbeVolume, kind: Kind, squares: readonly Square[]): number[][] {
    const scene = new three.Scene();
    const material = makeMaterial(kind);
    const meshes = squares.map(square => {
        const mesh = new three.Mesh(kGeometry, material);
        mesh.applyMatrix4(placeOf(square));
        scene.add(mesh);
        return mesh;
    });
    scene.updateMatrixWorld();
    probes.add(scene);
    probes.update();
    const colors = squares.map(({position, normal}, i) => {
        meshes.forEach((mesh, k) => { mesh.visible = i === k; });
        return colorOf(scene, cameraAt(vector(position), vector(normal)));
    });
    probes.remove(scene);
    if (meshes.some(mesh => mesh.material !== material)) throw new Error('the material is not that of before');
    return colors;
}

/** The colors of squares that one object holds. */
function colorsOf(probes: ProbeVolume, mesh: three.Object3D, squares: readonly Square[]): number[][] {
    const scene = new three.Scene().add(mesh);
    probes.add(scene);
    probes.update();
    const colors = squares.map(({position, normal}) => colorOf(scene, cameraAt(vector(position), vector(normal))));
    probes.remove(scene);
    return colors;
}

/** All squares as instances in one draw. */
function shadeInstances(probes: ProbeVolume, kind: Kind, squares: readonly Square[]): number[][] {
    const mesh = new three.InstancedMesh(kGeometry, makeMaterial(kind), squares.length);
    squares.forEach((square, i) => mesh.setMatrixAt(i, placeOf(square)));
    mesh.frustumCulled = false;
    return colorsOf(probes, mesh, squares);
}

/** All squares as instances of a batch, after others were deleted. */
function shadeBatch(probes: ProbeVolume, kind: Kind, squares: readonly Square[]): number[][] {
    const mesh = new three.BatchedMesh(2 * squares.length, 8, 12, makeMaterial(kind));
    const geometry = mesh.addGeometry(kGeometry);
    const instances = squares.flatMap(square => [square, square].map(each => {
        const instance = mesh.addInstance(geometry);
        mesh.setMatrixAt(instance, placeOf(each));
        return instance;
    }));
    instances.forEach((instance, i) => { if (i % 2 === 0) mesh.deleteInstance(instance); });
    return colorsOf(probes, mesh, squares);
}

/** A square of which a bone moves all corners, in place of the mesh. */
function shadeSkin(probes: ProbeVolume, kind: Kind, squares: readonly Square[]): number[][] {
    const geometry = kGeometry.clone();
    const count = geometry.attributes.position.count;
    geometry.setAttribute('skinIndex', new three.Uint16BufferAttribute(new Uint16Array(4 * count), 4));
    const weights = new Float32Array(4 * count).map((_, i) => i % 4 === 0 ? 1 : 0);
    geometry.setAttribute('skinWeight', new three.Float32BufferAttribute(weights, 4));
    const mesh = new three.SkinnedMesh(geometry, makeMaterial(kind));
    const bone = new three.Bone();
    mesh.add(bone);
    mesh.bind(new three.Skeleton([bone]));
    const scene = new three.Scene().add(mesh);
    probes.add(scene);
    const colors = squares.map(square => {
        mesh.matrix.identity().decompose(mesh.position, mesh.quaternion, mesh.scale);
        mesh.applyMatrix4(placeOf(square));
        scene.updateMatrixWorld();
        probes.update();
        return colorOf(scene, cameraAt(vector(square.position), vector(square.normal)));
    });
    probes.remove(scene);
    return colors;
}

/** The picture of one square before and after the layers of the volume change. */
function dim(probes: ProbeVolume, square: Square, weights: Record<string, number>): number[][] {
    const mesh = new three.Mesh(kGeometry, makeMaterial('standard'));
    mesh.applyMatrix4(placeOf(square));
    const scene = new three.Scene().add(mesh);
    scene.updateMatrixWorld();
    probes.add(scene);
    probes.update();
    const camera = cameraAt(vector(square.position), vector(square.normal));
    const before = colorOf(scene, camera);
    probes.volume.setWeights(weights);
    probes.refresh();
    const after = colorOf(scene, camera);
    probes.remove(scene);
    return [before, after];
}

/** Squares lit by the grid of three.js in a box. */
function grid({volume}: ProbeVolume, squares: readonly Square[], low: readonly number[], high: readonly number[],
              resolution: readonly [number, number, number]): number[][] {
    const scene = new three.Scene();
    const light = toLightProbeGrid(volume, new three.Box3(vector(low), vector(high)), resolution);
    scene.add(light);
    const material = makeMaterial('lambert');
    const colors = squares.map(square => {
        const mesh = new three.Mesh(kGeometry, material);
        mesh.applyMatrix4(placeOf(square));
        scene.add(mesh);
        const color = colorOf(scene, cameraAt(vector(square.position), vector(square.normal)));
        scene.remove(mesh);
        return color;
    });
    light.dispose();
    return colors;
}

function open(base64: string): ProbeVolume {
    return new ProbeVolume(read(Uint8Array.from(atob(base64), c => c.charCodeAt(0))));
}

export const page = {dim, grid, open, batch: shadeBatch, instances: shadeInstances, meshes: shadeMeshes, skin: shadeSkin};
Object.assign(window, {page});
