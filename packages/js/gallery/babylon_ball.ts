// SPDX-License-Identifier: Apache-2.0
import {FreeCamera} from '@babylonjs/core/Cameras/freeCamera.js';
import {Engine} from '@babylonjs/core/Engines/engine.js';
import {PBRMaterial} from '@babylonjs/core/Materials/PBR/pbrMaterial.js';
import {Color4} from '@babylonjs/core/Maths/math.color.js';
import {Vector3} from '@babylonjs/core/Maths/math.vector.js';
import {CreateSphere} from '@babylonjs/core/Meshes/Builders/sphereBuilder.js';
import {Scene} from '@babylonjs/core/scene.js';

import {ProbeVolume} from '../src/babylon/index.js';
import type {MakeBallView} from './ball_view.js';
import {eyeOf, kFieldOfView, kRadius} from './road.js';

export const makeBabylonBall: MakeBallView = async (canvas, volume, exposure) => {
    const {width, height} = canvas;
    const engine = new Engine(canvas, true, {preserveDrawingBuffer: true, useExactSrgbConversions: true});
    engine.setSize(width, height);  // not that on the page
    const scene = new Scene(engine);
    scene.useRightHandedSystem = true;
    scene.clearColor = new Color4(0, 0, 0, 1);
    scene.imageProcessingConfiguration.exposure = exposure;
    const camera = new FreeCamera('camera', Vector3.Zero(), scene);
    camera.fov = kFieldOfView * Math.PI / 180;
    [camera.minZ, camera.maxZ] = [0.1, 10];
    const material = new PBRMaterial('white', scene);
    material.metallic = 0;
    material.roughness = 1;
    material.metallicF0Factor = 0;
    const ball = CreateSphere('ball', {diameter: 2 * kRadius, segments: 48}, scene);
    ball.material = material;
    const probes = new ProbeVolume(volume);
    probes.add(ball);
    await scene.whenReadyAsync();
    return {
        name: `Babylon ${Engine.Version}`,
        draw(position) {
            ball.position = Vector3.FromArray(position as unknown as number[]);
            ball.computeWorldMatrix(true);
            camera.position = Vector3.FromArray(eyeOf(position) as unknown as number[]);
            camera.setTarget(ball.position);
            probes.update();
            scene.render();
            return Promise.resolve();
        },
    };
};
