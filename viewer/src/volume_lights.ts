// SPDX-License-Identifier: Apache-2.0
// The lights that a volume was baked with, whose direct term its probes leave out: the twin of `runtime_lights`.
import * as three from 'three';

import {aimShadows} from './scene_model';

export interface VolumeLight {
    type: LightType;
    intensity: number[];  // lux or candela, RGB
    position: number[];
    direction: number[];  // from the light
    range: number;        // metres; 0: without end
    innerCone: number;    // radians from the axis
    outerCone: number;
    layer: number;        // the one that its bounces are in, or none
}

/** Rectangles and discs, which come after these, have no direct term here. */
export enum LightType { Directional, Point, Spot }

const kBaked = 1;

/** Sections `lights` and `light_states`; lights that are baked as a whole are left out. */
export function readLights(lights: ArrayBuffer, states: ArrayBuffer): VolumeLight[] {
    const [kLightSize, kStateSize] = [88, 16];
    const view = new DataView(lights);
    const stateView = new DataView(states);
    const found: VolumeLight[] = [];
    for (let i = 0; (i + 1) * kLightSize <= lights.byteLength; ++i) {
        const at = i * kLightSize;
        const number = (offset: number) => view.getFloat32(at + offset, true);
        const vector = (offset: number) => [0, 4, 8].map(c => number(offset + c));
        const type = view.getUint32(at, true);
        if (type > LightType.Spot || view.getUint32(at + 4, true) === kBaked) continue;
        const hasState = (i + 1) * kStateSize <= states.byteLength;
        found.push({
            type, intensity: vector(8), position: vector(20), direction: vector(32), range: number(44),
            innerCone: Math.acos(number(48)), outerCone: Math.acos(number(52)),
            layer: hasState ? stateView.getUint32(i * kStateSize + 8, true) : -1,
        });
    }
    return found;
}

/** The lights for a scene in a box, dark until `dimLights`. */
export function makeLights(lights: readonly VolumeLight[], box: three.Box3): three.Group {
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

function makeLight({type, range, innerCone, outerCone}: VolumeLight) {
    if (type === LightType.Point) return new three.PointLight(undefined, 0, range);
    if (type === LightType.Spot) return new three.SpotLight(undefined, 0, range, outerCone, 1 - innerCone / outerCone);
    const sun = new three.DirectionalLight(undefined, 0);
    sun.castShadow = true;
    return sun;
}

/** Lights shine as much as the layers do that their bounces are in. */
export function dimLights(group: three.Group, weights: readonly number[]): void {
    for (const light of group.children as three.Light[]) {
        light.intensity = light.userData.strength * (weights[light.userData.layer] ?? 1);
    }
}
