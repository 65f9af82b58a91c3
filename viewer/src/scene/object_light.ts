// SPDX-License-Identifier: Apache-2.0
// The light of an object that moves: that at its center, or a grid of light around it, as its node says.
import type {Volume} from 'tetralight';
import * as three from 'three';

import type {Answers} from '../light/answers';
import {Grid, LightField} from '../light/light_field';
import {PlaceLight} from '../light/place_light';
import {lightByLppv, lightByPlace} from '../light/shaders';
import {boxOf, SceneObject} from './scene_objects';
import {isSmooth} from './smooth_mesh';

const kPointsPerMeter = 2;
const kMostPoints = 16;  // along an axis: a grid is filled at each step of a drag

export class ObjectLight {
    private readonly light: PlaceLight | LightField;

    constructor(readonly object: SceneObject) {
        const materials = object.meshes.flatMap(mesh => mesh.material);
        if (object.hasProxyVolume) {
            const field = new LightField();
            for (const material of materials) lightByLppv(material, field.uniforms);
            this.light = field;
        } else {
            const light = new PlaceLight();
            const at = object.meshes.every(mesh => isSmooth(mesh.geometry)) ? 'vertices' : 'pixels';  // meshes share materials
            for (const material of materials) lightByPlace(material, light.uniforms, at);
            this.light = light;
        }
    }

    /** Finds the light where the object is now. */
    place(volume: Volume | null): void {
        const {light, object} = this;
        if (volume === null || volume.irradiance.length === 0) light.clear();
        else if (light instanceof LightField) light.place(volume, lightGrid(object));
        else light.place(volume, boxOf(object).getCenter(new three.Vector3()).toArray());
    }

    /** Shows another light, or that of its volume. */
    showLight(answers: Answers | null): void {
        this.light.showLight(answers);
    }

    dispose(): void {
        if (this.light instanceof LightField) this.light.uniforms.lppv.value?.dispose();
    }
}

/** The grid of light over an object. */
export function lightGrid(object: SceneObject): Grid {
    const box = boxOf(object);
    const center = box.getCenter(new three.Vector3());
    const size = box.getSize(new three.Vector3()).max(new three.Vector3(1e-3, 1e-3, 1e-3));
    const resolution = size.toArray().map(
        length => Math.min(kMostPoints, Math.max(2, Math.ceil(kPointsPerMeter * length) + 1)));
    return {low: center.addScaledVector(size, -0.5), size, resolution};
}
