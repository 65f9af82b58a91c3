// SPDX-License-Identifier: Apache-2.0
// A day of a minute: the weights of the layers "sun" and "sky" of the bake change. The sun stays where it was baked.
import * as three from 'three';

import {Figure} from './figure.js';
import {say, Stage, start} from './stage.js';

const kDay = 60;  // seconds
const kMoon = 0.03;

/** Weights of an hour from 0 to 24. */
function weightsAt(hour: number): {sun: number; sky: number} {
    const height = Math.sin(Math.PI * (hour - 6) / 12);
    return {sun: Math.max(0, height), sky: Math.max(kMoon, Math.min(1, 0.3 + height))};
}

function begin({volume, probes, lightmaps, scene, box, lights, sky, groundBelow, run}: Stage): void {
    const names = volume.layers.map(({name}) => name);
    if (!['sun', 'sky'].every(name => names.includes(name))) {
        throw new Error(`the volume has the layers "${names.join(', ')}", and not sun and sky: bake it with --layers sun,sky`);
    }
    const figure = new Figure(0xdddddd);
    scene.add(figure.mesh);
    box.getCenter(figure.mesh.position);
    figure.mesh.position.x = 0.6 * box.max.x + 0.4 * figure.mesh.position.x;
    figure.mesh.position.y = groundBelow(figure.mesh.position);
    figure.mesh.updateMatrixWorld();
    probes.add(figure.mesh, figure.mesh.skeleton.bones[0]);
    const intensities = lights.map(({intensity}) => intensity);
    const noon = sky.clone();
    let shown = -1;
    run(time => {
        const hour = (24 * time / kDay + 9) % 24;
        // Ten times an hour is often enough.
        if (Math.floor(10 * hour) === shown) return;
        shown = Math.floor(10 * hour);
        const weights = weightsAt(hour);
        volume.setWeights(weights);
        probes.refresh();
        lightmaps?.setWeights(weights);
        lights.forEach((light, i) => {
            if (light instanceof three.DirectionalLight) light.intensity = weights.sun * intensities[i];
        });
        sky.copy(noon).multiplyScalar(weights.sky);
        say(`${Math.floor(hour)}:${String(Math.floor(60 * (hour % 1))).padStart(2, '0')}`);
    });
}

start(begin);
