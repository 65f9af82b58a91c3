// SPDX-License-Identifier: Apache-2.0
import {kCoefficients, Light, Volume} from 'tetralight';
import {expect, test} from 'vitest';

import {lightShares, sourceWords} from '../../src/light/light_sources';

/** Grey light in all directions, probe after probe. */
const grey = (...values: number[]) => Float32Array.from(
    {length: kCoefficients * values.length}, (_, i) => i % kCoefficients < 3 ? values[Math.floor(i / kCoefficients)] : 7);

/** Two probes with two layers, at these weights. */
function volumeOf(sky: number, lamp: number): Volume {
    const each = [[2, 6], [1, 1]];
    const irradiance = grey(...[0, 1].map(probe => sky * each[0][probe] + lamp * each[1][probe]));
    return {
        probeCount: 2, irradiance, layers: [{name: 'sky', weight: sky}, {name: 'light:lamp', weight: lamp}],
        data: {layerIrradiance: grey(...each.flat()), layers: [{ambient: grey(4)}, {ambient: grey(0)}]},
    } as unknown as Volume;
}

const lightOf = (value: number, weights: number[], ambient = 0) => (
    {probes: [0, 1], weights, ambient, sh: grey(value)}) as unknown as Light;

test('shares are those of the layers at the weights of the place', () => {
    expect(lightShares(volumeOf(1, 1), lightOf(5, [0.5, 0.5]))).toEqual([
        {layer: 'sky', share: 0.8}, {layer: 'light:lamp', share: 0.2}]);
    expect(lightShares(volumeOf(0, 3), lightOf(3, [0.5, 0.5]))).toEqual([
        {layer: 'sky', share: 0}, {layer: 'light:lamp', share: 1}]);
    expect(lightShares(volumeOf(1, 1), lightOf(4, [0, 0], 1))[0].share).toBe(1);  // the environment alone
});

test('the words say how bright a place is beside all probes, and from what', () => {
    const volume = volumeOf(1, 1);  // a mean of 5
    expect(sourceWords(volume, lightOf(5, [0.5, 0.5]))).toBe('As bright as the mean of all probes: 80 % sky, 20 % lamp.');
    expect(sourceWords(volume, lightOf(1.25, [1, 0]))).toBe('2.0 stops darker than the mean of all probes: 67 % sky, 33 % lamp.');
    expect(sourceWords(volumeOf(0, 0), lightOf(0, [1, 0]))).toBe('');
});

test('a volume without layers has a brightness only', () => {
    const volume = {probeCount: 1, irradiance: grey(1), layers: [], data: {layerIrradiance: new Float32Array(), layers: []}};
    expect(sourceWords(volume as unknown as Volume, lightOf(2, [1, 0]))).toBe('1.0 stops brighter than the mean of all probes.');
});
