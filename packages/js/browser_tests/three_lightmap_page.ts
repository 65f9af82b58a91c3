// SPDX-License-Identifier: Apache-2.0
// What the tests of lightmaps run in the browser, as `window.page`.
import * as three from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';

import {LayerWeights, readLightmaps} from '../src/index.js';
import {SceneLightmaps} from '../src/three/index.js';
import {cameraAt, kSize} from './three_squares.js';
import {kit} from './three_webgl_kit.js';

/** A place on a surface with a lightmap: UVs of the mesh, and the color of a picture of it. */
export interface Shown {
    name: string;
    uv: number[];
    color: number[];
}

const bytesOf = (base64: string) => Uint8Array.from(atob(base64), c => c.charCodeAt(0)).buffer;

/** The middle of a triangle: its world position, normal and UVs. */
function middleOf({geometry, matrixWorld}: three.Mesh, triangle: number) {
    const corners = [0, 1, 2].map(i => geometry.index!.getX(3 * triangle + i));
    const [a, b, c] = corners.map(i =>
        new three.Vector3().fromBufferAttribute(geometry.attributes.position, i).applyMatrix4(matrixWorld));
    const uvs = corners.map(i => new three.Vector2().fromBufferAttribute(geometry.attributes.uv1 as three.BufferAttribute, i));
    const normal = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
    return {position: a.add(b).add(c).divideScalar(3).toArray(), normal: normal.toArray(),
            uv: uvs[0].add(uvs[1]).add(uvs[2]).divideScalar(3).toArray()};
}

/** A few triangles of each mesh, with grey Lambert materials instead of those of the file. */
async function show(scene64: string, lightmaps64: string, weights?: LayerWeights): Promise<Shown[]> {
    const {scene} = await new GLTFLoader().parseAsync(bytesOf(scene64), '');
    const material = new three.MeshLambertMaterial({color: new three.Color(0.5, 0.5, 0.5)});
    const meshes: three.Mesh[] = [];
    const lights: three.Object3D[] = [];
    scene.traverse(object => {
        if (object instanceof three.Mesh) meshes.push(object);
        if (object instanceof three.Light) lights.push(object);
    });
    for (const light of lights) light.removeFromParent();
    for (const mesh of meshes) mesh.material = material;
    scene.updateMatrixWorld();
    const lightmaps = new SceneLightmaps(readLightmaps(bytesOf(lightmaps64)), scene);
    if (weights) {
        await kit.readPixels(scene, cameraAt({position: [0, 1, 0], normal: [0, 0, 1]}, 5));  // uploads the old texels
        lightmaps.setWeights(weights);
    }
    const shown: Shown[] = [];
    for (const mesh of lightmaps.meshes) {
        for (const other of meshes) other.visible = other === mesh;
        for (const triangle of [0, mesh.geometry.index!.count / 3 - 1]) {
            const {position, normal, uv} = middleOf(mesh, triangle);
            const pixels = await kit.readPixels(scene, cameraAt({position, normal}, 1e-4, 0.01));
            shown.push({name: mesh.name, uv, color: [...pixels.slice(4 * (kSize * kSize / 2 + kSize / 2)).slice(0, 3)]});
        }
    }
    lightmaps.dispose();
    if (meshes.some(mesh => mesh.material !== material)) throw new Error('the material is not that of before');
    return shown;
}

/** The message of the error. */
async function refuse(scene64: string, lightmaps64: string): Promise<string> {
    return show(scene64, lightmaps64).then(() => '', error => (error as Error).message);
}

export const page = {show, refuse};
Object.assign(window, {page});
