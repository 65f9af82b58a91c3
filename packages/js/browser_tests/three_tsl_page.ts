// SPDX-License-Identifier: Apache-2.0
// What the tests run in the browser, as `window.page`, with WebGPURenderer and its WebGL 2 backend.
import * as three from 'three';
import {MeshLambertNodeMaterial, MeshPhongNodeMaterial, MeshPhysicalNodeMaterial, MeshStandardNodeMaterial,
        WebGPURenderer} from 'three/webgpu';

import {NodeProbeVolume} from '../src/three/tsl.js';
import {Kind, Kit, kSize, kSphereSize, Squares} from './three_squares.js';

const renderer = new WebGPURenderer({forceWebGL: true});
const target = new three.RenderTarget(kSize, kSize, {type: three.FloatType});

const kit: Kit = {
    async readPixels(scene, camera) {
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        return await renderer.readRenderTargetPixelsAsync(target, 0, 0, kSize, kSize) as Float32Array;
    },
    draw(scene, camera, exposure) {
        renderer.setRenderTarget(null);
        renderer.toneMapping = three.LinearToneMapping;
        renderer.toneMappingExposure = exposure;
        renderer.render(scene, camera);
        return renderer.domElement as HTMLCanvasElement;
    },
    makeMaterial(kind: Kind, color: three.Color) {
        switch (kind) {
            case 'standard': return new MeshStandardNodeMaterial({color, roughness: 1, metalness: 0});
            case 'physical': return new MeshPhysicalNodeMaterial({color, roughness: 1, metalness: 0, specularIntensity: 0});
            case 'lambert': return new MeshLambertNodeMaterial({color});
            case 'phong': return new MeshPhongNodeMaterial({color, specular: 0});
        }
    },
    makeProbes: volume => new NodeProbeVolume(volume),
};

class Page extends Squares {
    /** Comes before all else. */
    async begin(): Promise<string> {
        await renderer.init();
        renderer.setSize(kSphereSize, kSphereSize);
        return (renderer.backend as unknown as {isWebGLBackend?: true}).isWebGLBackend ? 'WebGL 2' : 'WebGPU';
    }

    /** From now on materials are those that WebGPURenderer turns into node materials itself. */
    useClassicMaterials(): void {
        kit.makeMaterial = (_, color) => new three.MeshLambertMaterial({color});
    }
}

export const page = new Page(kit);
Object.assign(window, {page});
