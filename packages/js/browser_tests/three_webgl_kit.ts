// SPDX-License-Identifier: Apache-2.0
// WebGLRenderer for the pages of the tests.
import * as three from 'three';

import {ProbeVolume} from '../src/three/index.js';
import {Kind, Kit, kSize, kSphereSize} from './three_squares.js';

export const renderer = new three.WebGLRenderer();
renderer.setSize(kSphereSize, kSphereSize);
const target = new three.WebGLRenderTarget(kSize, kSize, {type: three.FloatType});

export const kit: Kit = {
    async readPixels(scene, camera) {
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        const pixels = new Float32Array(4 * kSize * kSize);
        renderer.readRenderTargetPixels(target, 0, 0, kSize, kSize, pixels);
        return pixels;
    },
    draw(scene, camera, exposure) {
        renderer.setRenderTarget(null);
        renderer.toneMapping = three.LinearToneMapping;
        renderer.toneMappingExposure = exposure;
        renderer.render(scene, camera);
        return renderer.domElement;
    },
    makeMaterial(kind: Kind, color: three.Color) {
        switch (kind) {
            case 'standard': return new three.MeshStandardMaterial({color, roughness: 1, metalness: 0});
            case 'physical': return new three.MeshPhysicalMaterial({color, roughness: 1, metalness: 0, specularIntensity: 0});
            case 'lambert': return new three.MeshLambertMaterial({color});
            case 'phong': return new three.MeshPhongMaterial({color, specular: 0});
        }
    },
    makeProbes: volume => new ProbeVolume(volume),
};
