// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import type {OtherLight} from '../../src/light/other_light';
import {SceneLights} from '../../src/scene/scene_lights';
import type {Shown} from '../../src/scene/shown';

const kBox = new three.Box3(new three.Vector3(-1, -1, -1), new three.Vector3(1, 1, 1));

function sceneWith(sky: number[] | null) {
    const lamp = new three.MeshLambertMaterial({name: 'lamp', emissiveIntensity: 3});
    const light = new three.PointLight();
    return {lamp, light, model: {root: new three.Group(), emitters: [lamp], lights: [light], sky}};
}

const volumeWith = (layers: {name: string; weight: number}[], sky: number[] = []) => ({
    probes: {layers, lights: [], irradiance: new Float32Array(27), data: {sky: Float32Array.from(sky)}}});

function lightsOf(shown: object) {
    const sky = new three.Color();
    const sceneLights = new SceneLights({volume: null, model: null, bake: null, box: kBox, ...shown} as unknown as Shown,
                                     new three.Scene(), sky);
    sceneLights.choose();
    return {sceneLights, sky};
}

test('the sky is the scene\'s, unless the bake or the volume knows another', () => {
    const {model} = sceneWith([1, 2, 3]);
    expect(lightsOf({model}).sky.toArray()).toEqual([1, 2, 3]);
    expect(lightsOf({model, bake: {request: {sky: 4}}}).sky.toArray()).toEqual([4, 4, 4]);
    const y0 = 0.5 / Math.sqrt(Math.PI);
    const volume = volumeWith([], [5 / y0, 6 / y0, 7 / y0]);
    lightsOf({model, volume}).sky.toArray().forEach((x, i) => expect(x).toBeCloseTo([5, 6, 7][i], 5));
});

test('emission and sky shine as much as their layers do', () => {
    const {model, lamp} = sceneWith([1, 1, 1]);
    const layers = [{name: 'sky', weight: 0.5}, {name: 'emission', weight: 2}, {name: 'rest', weight: 9}];
    const {sceneLights, sky} = lightsOf({model, volume: volumeWith(layers)});
    expect(lamp.emissiveIntensity).toBe(6);
    expect(sky.r).toBe(0.5);
    layers.push({name: 'material:lamp', weight: 0});
    sceneLights.dim();
    expect(lamp.emissiveIntensity).toBe(0);
});

test('lights of the scene rest while a volume that was baked is open', () => {
    const {model, light} = sceneWith(null);
    lightsOf({model});
    expect(light.visible).toBe(true);
    lightsOf({model, volume: volumeWith([])});
    expect(light.visible).toBe(false);
});

test('the lights of another volume shine for one picture', () => {
    const {model, light, lamp} = sceneWith([1, 1, 1]);
    const {sceneLights, sky} = lightsOf({model});
    const lights = new three.Group();
    const other = {lights, layers: [{name: 'emission', weight: 0}], sky: [2, 2, 2]} as unknown as OtherLight;
    let drawn: unknown = null;
    sceneLights.drawBy(other, () => { drawn = [light.visible, lights.parent !== null, lamp.emissiveIntensity, sky.r]; });
    expect(drawn).toEqual([false, true, 0, 2]);
    expect([light.visible, lights.parent !== null, lamp.emissiveIntensity, sky.r]).toEqual([true, false, 3, 1]);
});
