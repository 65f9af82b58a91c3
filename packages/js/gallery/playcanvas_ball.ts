// SPDX-License-Identifier: Apache-2.0
import * as pc from 'playcanvas';

import {ProbeVolume} from '../src/playcanvas/index.js';
import type {MakeBallView} from './ball_view.js';
import {eyeOf, kFieldOfView, kRadius} from './road.js';

export const makePlayCanvasBall: MakeBallView = (canvas, volume, exposure) => {
    const app = new pc.Application(canvas, {graphicsDeviceOptions: {antialias: true, preserveDrawingBuffer: true}});
    app.autoRender = false;
    app.setCanvasResolution(pc.RESOLUTION_FIXED, canvas.width, canvas.height);
    app.scene.exposure = exposure;
    app.start();
    const camera = new pc.Entity('camera');
    camera.addComponent('camera', {fov: kFieldOfView, nearClip: 0.1, farClip: 10, toneMapping: pc.TONEMAP_LINEAR,
                                   gammaCorrection: pc.GAMMA_SRGB, clearColor: new pc.Color(0, 0, 0)});
    app.root.addChild(camera);
    const material = new pc.StandardMaterial();
    material.update();
    const geometry = new pc.SphereGeometry({radius: kRadius, latitudeBands: 48, longitudeBands: 96});
    const ball = new pc.Entity('ball');
    const mesh = pc.Mesh.fromGeometry(app.graphicsDevice, geometry);
    ball.addComponent('render', {meshInstances: [new pc.MeshInstance(mesh, material)]});
    app.root.addChild(ball);
    const probes = new ProbeVolume(volume, app.scene);
    probes.add(ball);
    return Promise.resolve({
        name: `PlayCanvas ${pc.version}`,
        draw(position) {
            ball.setPosition(...position);
            camera.setPosition(...eyeOf(position));
            camera.lookAt(ball.getPosition());
            probes.update();
            app.render();
            return Promise.resolve();
        },
    });
};
