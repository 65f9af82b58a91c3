// SPDX-License-Identifier: Apache-2.0
// A character walks around the middle of the scene, in and out of shadows.
import * as three from 'three';

import {Figure} from './figure.js';
import {parameter, say, Stage, start} from './stage.js';

const kSpeed = 1.2;  // metres a second

function begin({probes, scene, box, groundBelow, run}: Stage): void {
    const figure = new Figure(0xdddddd);
    const {mesh} = figure;
    scene.add(mesh);
    mesh.updateMatrixWorld();
    probes.add(mesh, mesh.skeleton.bones[0]);
    const size = box.getSize(new three.Vector3());
    const center = box.getCenter(new three.Vector3());
    const radius = parameter('radius', 0.2 * Math.min(size.x, size.z));
    const [x, z] = [parameter('x', center.x), parameter('z', center.z)];
    say('A character with the light of probes');
    run(time => {
        const angle = Math.PI / 2 - kSpeed * time / radius;
        mesh.position.set(x + radius * Math.cos(angle), box.min.y + 1.5, z + radius * Math.sin(angle));
        mesh.position.y = groundBelow(mesh.position);
        mesh.rotation.y = Math.PI - angle;
        figure.walk(kSpeed * time);
    });
}

start(begin);
