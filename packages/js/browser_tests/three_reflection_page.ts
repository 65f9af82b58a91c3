// SPDX-License-Identifier: Apache-2.0
// What the tests of reflections run in the browser, as `window.page`.
import * as three from 'three';

import {LayerWeights, readReflections} from '../src/index.js';
import {SceneReflections} from '../src/three/index.js';
import {cameraAt, kSize, Square, vector} from './three_squares.js';
import {kit} from './three_webgl_kit.js';

/** A square of white metal, and the direction from it to the camera. */
export interface Mirror extends Square {
    toEye: readonly number[];
}

/** The radiance that squares of a roughness show under an ambient irradiance. */
async function mirror(base64: string, squares: readonly Mirror[], roughness: number, ambient: number,
                      weights?: LayerWeights): Promise<number[][]> {
    const reflections = new SceneReflections(readReflections(Uint8Array.from(atob(base64), c => c.charCodeAt(0))));
    const material = new three.MeshStandardMaterial({color: 0xffffff, metalness: 1, roughness, side: three.DoubleSide});
    const mesh = new three.Mesh(new three.PlaneGeometry(1, 1), material);
    const scene = new three.Scene().add(mesh, new three.AmbientLight(0xffffff, ambient));
    reflections.add(scene);
    if (weights) reflections.setWeights(weights);
    const colors = [];
    for (const {position, normal, toEye} of squares) {
        mesh.position.copy(vector(position));
        mesh.quaternion.setFromUnitVectors(new three.Vector3(0, 0, 1), vector(normal));
        scene.updateMatrixWorld();
        reflections.update();
        const pixels = await kit.readPixels(scene, cameraAt({position, normal: toEye}, 1e-4, 0.05));
        colors.push([...pixels.slice(4 * (kSize * kSize / 2 + kSize / 2)).slice(0, 3)]);
    }
    reflections.dispose();
    if (mesh.material !== material) throw new Error('the material is not that of before');
    return colors;
}

export const page = {mirror};
Object.assign(window, {page});
