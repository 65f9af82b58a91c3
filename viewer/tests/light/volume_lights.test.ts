// SPDX-License-Identifier: Apache-2.0
import type {BakedLight} from 'tetralight';
import * as three from 'three';
import {expect, test} from 'vitest';

import {dimLights, directLights, makeLights} from '../../src/light/volume_lights';

const kSun: BakedLight = {
    name: 'sun', type: 'directional', mode: 'mixed', intensity: [8, 4, 2], position: [0, 0, 0], direction: [0, -1, 0],
    range: 0, cosInnerCone: 1, cosOuterCone: 0, mixedLighting: 'indirect', channel: undefined, layer: 1,
};
const kSpot: BakedLight = {
    ...kSun, name: 'spot', type: 'spot', intensity: [1, 2, 4], position: [5, 6, 7], direction: [1, 0, 0], range: 9,
    cosInnerCone: Math.cos(0.2), cosOuterCone: Math.cos(0.4), layer: undefined,
};

test('lights that are baked as a whole are left out, and areas', () => {
    const lights: BakedLight[] = [{...kSun, mode: 'baked'}, kSun, {...kSpot, type: 'disc'}, {...kSpot, mode: 'realtime'}];
    expect(directLights({lights} as never)).toEqual([lights[1], lights[3]]);
});

test('lights shine along their direction, as much as their layer does', () => {
    const box = new three.Box3(new three.Vector3(-3, -3, -3), new three.Vector3(3, 3, 3));
    const group = makeLights([kSun, kSpot], box);
    const weights = (sun: number) => [{name: 'sky', weight: 1}, {name: 'sun', weight: sun}];
    dimLights(group, weights(0.5));
    const [sun, spot] = group.children as [three.DirectionalLight, three.SpotLight];
    const light = (of: three.Light) => of.color.toArray().map(value => value * of.intensity);
    expect(light(sun)).toEqual([4, 2, 1]);
    expect(light(spot)).toEqual([1, 2, 4]);
    group.updateMatrixWorld(true);
    const along = sun.target.getWorldPosition(new three.Vector3()).sub(sun.getWorldPosition(new three.Vector3()));
    expect(along.normalize().distanceTo(new three.Vector3(0, -1, 0))).toBeLessThan(1e-6);
    expect(spot.target.getWorldPosition(new three.Vector3()).toArray()).toEqual([6, 6, 7]);
    dimLights(group, weights(0));
    expect(light(sun)).toEqual([0, 0, 0]);
    expect(light(spot)).toEqual([1, 2, 4]);
});

test('spots have the cone and the range of the bake', () => {
    const box = new three.Box3(new three.Vector3(-3, -3, -3), new three.Vector3(3, 3, 3));
    const spot = makeLights([kSpot], box).children[0] as three.SpotLight;
    expect([spot.distance, spot.angle, spot.angle * (1 - spot.penumbra)].map(x => x.toFixed(4)))
        .toEqual(['9.0000', '0.4000', '0.2000']);
});
