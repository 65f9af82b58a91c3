// SPDX-License-Identifier: Apache-2.0
import {kPacked, packSh} from 'tetralight';
import {expect, test} from 'vitest';

import {Answers, constantAnswers} from '../../src/light/answers';
import {PlaceLight} from '../../src/light/place_light';

/** Its light is the place: the first float of all. */
const volume = {batch: (positions: ArrayLike<number>, {packed}: {packed: Float32Array}) => packed.fill(positions[0])} as unknown as Answers;

test('the light is that of the place, or of a side of a comparison there', () => {
    const light = new PlaceLight();
    const shown = () => light.uniforms.placeSh.value;
    expect(shown()).toEqual(new Float32Array(kPacked));
    light.place(volume, [2, 0, 0]);
    expect(shown()).toEqual(new Float32Array(kPacked).fill(2));
    const dark = constantAnswers(new Float32Array(27));
    const packedDark = new Float32Array(kPacked);
    packSh(new Float32Array(27), 0, packedDark, 0);
    light.showLight(dark);
    expect(shown()).toEqual(packedDark);
    light.showLight(null);
    expect(shown()[0]).toBe(2);
    light.place(volume, [3, 0, 0]);
    expect(shown()[0]).toBe(3);
    light.clear();
    light.showLight(dark);
    expect(shown()[0]).toBe(0);
});
