// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {layerChoices} from '../../src/bake/bake_layers';

const named = <T extends three.Light>(light: T, name: string) => Object.assign(light, {userData: {name}});
const glowing = (emissive: number) => new three.MeshLambertMaterial({emissive});
const offered = (...model: Parameters<typeof layerChoices>) =>
    layerChoices(...model).filter(({isOffered}) => isOffered).map(({layer}) => layer);

test('without a scene the usual layers are offered', () => {
    expect(offered(null)).toEqual(['sky', 'sun', 'emission']);
});

test('a sun and emission are offered where the scene has them', () => {
    expect(offered({lights: [], emitters: [glowing(0)]})).toEqual(['sky']);
    expect(offered({lights: [new three.DirectionalLight()], emitters: []})).toEqual(['sky', 'sun']);
    expect(offered({lights: [], emitters: [glowing(0), glowing(0x010000)]})).toEqual(['sky', 'emission']);
});

test('lamps have layers by the names of the file, once for each name', () => {
    const lights = [named(new three.PointLight(), 'desk lamp'), named(new three.SpotLight(), 'desk lamp'),
                    named(new three.PointLight(), 'a, b'), named(new three.PointLight(), ''), named(new three.SpotLight(), 'door')];
    expect(offered({lights, emitters: []})).toEqual(['sky', 'light:desk lamp', 'light:door']);
});

test('the lamp of a group has the name of its node', () => {
    const group = new three.Group();
    group.userData.name = 'ceiling.001';
    const light = new three.PointLight();
    group.add(light);
    expect(offered({lights: [light], emitters: []})).toEqual(['sky', 'light:ceiling.001']);
});
