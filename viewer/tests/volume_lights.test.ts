// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {dimLights, LightType, makeLights, readLights} from '../src/volume_lights';

const kNone = 0xffffffff;

/** As `Light` and `LightState` lie in files (docs/file_format.md). */
function sections(lights: {type: number; mode: number; layer: number; values: number[]}[]) {
    const bytes = new DataView(new ArrayBuffer(88 * lights.length));
    const states = new DataView(new ArrayBuffer(16 * lights.length));
    lights.forEach(({type, mode, layer, values}, i) => {
        bytes.setUint32(88 * i, type, true);
        bytes.setUint32(88 * i + 4, mode, true);
        values.forEach((value, k) => bytes.setFloat32(88 * i + 8 + 4 * k, value, true));
        states.setUint32(16 * i + 8, layer, true);
    });
    return [bytes.buffer, states.buffer] as const;
}

//             intensity   position    direction  range, cosines of the cone
const kSun =  [8, 4, 2,    0, 0, 0,    0, -1, 0,   0, 1, 0];
const kSpot = [1, 2, 4,    5, 6, 7,    1, 0, 0,    9, Math.cos(0.2), Math.cos(0.4)];
const kMixed = 0, kBaked = 1, kDisc = 4;

test('lights have the meaning of their bytes; baked ones and areas are left out', () => {
    const found = readLights(...sections([
        {type: 0, mode: kBaked, layer: 0, values: kSun}, {type: 0, mode: kMixed, layer: 1, values: kSun},
        {type: kDisc, mode: kMixed, layer: 1, values: kSpot}, {type: 2, mode: kMixed, layer: kNone, values: kSpot}]));
    expect(found.map(({type, layer}) => [type, layer])).toEqual([[LightType.Directional, 1], [LightType.Spot, kNone]]);
    expect(found[1]).toMatchObject({intensity: [1, 2, 4], position: [5, 6, 7], direction: [1, 0, 0], range: 9});
    expect([found[1].innerCone, found[1].outerCone].map(angle => angle.toFixed(4))).toEqual(['0.2000', '0.4000']);
    expect(readLights(new ArrayBuffer(0), new ArrayBuffer(0))).toEqual([]);
});

test('lights shine along their direction, as much as their layer does', () => {
    const lights = readLights(...sections([{type: 0, mode: kMixed, layer: 1, values: kSun},
                                           {type: 2, mode: kMixed, layer: kNone, values: kSpot}]));
    const box = new three.Box3(new three.Vector3(-3, -3, -3), new three.Vector3(3, 3, 3));
    const group = makeLights(lights, box);
    dimLights(group, [1, 0.5]);
    const [sun, spot] = group.children as [three.DirectionalLight, three.SpotLight];
    const light = (of: three.Light) => of.color.toArray().map(value => value * of.intensity);
    expect(light(sun)).toEqual([4, 2, 1]);
    expect(light(spot)).toEqual([1, 2, 4]);
    group.updateMatrixWorld(true);
    const along = sun.target.getWorldPosition(new three.Vector3()).sub(sun.getWorldPosition(new three.Vector3()));
    expect(along.normalize().distanceTo(new three.Vector3(0, -1, 0))).toBeLessThan(1e-6);
    expect(spot.target.getWorldPosition(new three.Vector3()).toArray()).toEqual([6, 6, 7]);
    dimLights(group, [1, 0]);
    expect(light(sun)).toEqual([0, 0, 0]);
    expect(light(spot)).toEqual([1, 2, 4]);
});
