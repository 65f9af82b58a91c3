// SPDX-License-Identifier: Apache-2.0
// The lights that a volume was baked with, whose direct term its probes leave out: the twin of `runtime_lights`.
import type {BakedLight, Layer, Volume} from 'tetralight';
import * as three from 'three';

import {aimShadows} from './shadows';

/** Rectangles and discs have no direct term here, and lights that are baked as a whole need none. */
export function directLights({lights}: Volume): BakedLight[] {
    const kinds = ['directional', 'point', 'spot'];
    return lights.filter(({type, mode}) => kinds.includes(type) && mode !== 'baked');
}

/** The lights for a scene in a box, dark until `dimLights`. */
export function makeLights(lights: readonly BakedLight[], box: three.Box3): three.Group {
    const group = new three.Group();
    for (const light of lights) {
        const strength = Math.max(...light.intensity, 1e-6);
        const made = makeLight(light);
        made.color.setRGB(...light.intensity.map(x => x / strength) as [number, number, number]);
        made.userData = {layer: light.layer, strength};
        made.position.fromArray(light.position);
        group.add(made);
        if (!(made instanceof three.PointLight)) {
            made.target.position.fromArray(light.direction);
            made.add(made.target);
        }
    }
    group.updateMatrixWorld(true);
    aimShadows(group, box);
    return group;
}

/** Takes lights out of the picture, and frees their shadow maps. */
export function dropLights(group: three.Group): void {
    group.removeFromParent();
    for (const light of group.children as three.Light[]) light.dispose();
}

function makeLight({type, range, cosInnerCone, cosOuterCone}: BakedLight) {
    if (type === 'point') return new three.PointLight(undefined, 0, range);
    const outerCone = Math.acos(cosOuterCone);
    if (type === 'spot') {
        return new three.SpotLight(undefined, 0, range, outerCone, 1 - Math.acos(cosInnerCone) / outerCone);
    }
    const sun = new three.DirectionalLight(undefined, 0);
    sun.castShadow = true;
    return sun;
}

/** Lights shine as much as the layers do that their bounces are in. */
export function dimLights(group: three.Group, layers: readonly Layer[]): void {
    for (const light of group.children as three.Light[]) {
        light.intensity = light.userData.strength * (layers[light.userData.layer]?.weight ?? 1);
    }
}
