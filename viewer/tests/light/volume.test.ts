// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {readVolume, skyOf} from '../../src/light/volume';

test('errors of a file name the volume', () => {
    expect(() => readVolume(new ArrayBuffer(10), 'court')).toThrow('the volume court is damaged: not a probe file');
});

test('a sky of constant radiance has that radiance', () => {
    const y0 = 1 / Math.sqrt(4 * Math.PI);  // the basis function: radiance L has the coefficient L / y0
    const sky = new Float32Array(48);
    sky.set([1, 2, 4].map(radiance => radiance / y0));
    skyOf({data: {sky}} as never)!.forEach((value, i) => expect(value).toBeCloseTo([1, 2, 4][i], 5));
    expect(skyOf({data: {sky: new Float32Array()}} as never)).toBeNull();
});
