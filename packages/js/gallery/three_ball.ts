// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';

import {ProbeVolume} from '../src/three/index.js';
import type {MakeBallView} from './ball_view.js';
import {eyeOf, kFieldOfView, kRadius} from './road.js';

export const makeThreeBall: MakeBallView = (canvas, volume, exposure) => {
    const renderer = new three.WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true});
    renderer.toneMapping = three.LinearToneMapping;
    renderer.toneMappingExposure = exposure;
    const scene = new three.Scene();
    const ball = new three.Mesh(new three.SphereGeometry(kRadius, 96, 48), new three.MeshLambertMaterial({color: 'white'}));
    scene.add(ball);
    const camera = new three.PerspectiveCamera(kFieldOfView, 1, 0.1, 10);
    const probes = new ProbeVolume(volume);
    probes.add(ball);
    return Promise.resolve({
        name: `three.js ${three.REVISION}`,
        draw(position) {
            ball.position.set(...position);
            camera.position.set(...eyeOf(position));
            camera.lookAt(ball.position);
            scene.updateMatrixWorld();
            probes.update();
            renderer.render(scene, camera);
            return Promise.resolve();
        },
    });
};
