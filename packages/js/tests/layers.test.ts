// SPDX-License-Identifier: Apache-2.0
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {read, TetralightError, Volume} from '../src/index.js';
import {Folder, kCommand, kCourtyard} from './command.js';
import {largestOf, makePositions} from './random.js';

const folder = new Folder();
afterAll(() => folder.remove());

describe.skipIf(kCommand === '' || kCourtyard === '')('layers', () => {
    let volume: Volume;
    beforeAll(() => { volume = read(folder.bake(undefined, '--layers', 'sun,sky,emission')); });

    const weight = (name: string) => volume.layers.find(layer => layer.name === name)?.weight;

    test('have the light of `tetralight relight` after their weights change', () => {
        volume.setWeights({sun: 0.25, emission: 3});
        expect([weight('sun'), weight('sky'), weight('emission')]).toEqual([0.25, 1, 3]);
        folder.run('relight', 'volume.probes', '-o', 'relit.probes', '--weights', 'sun=0.25,emission=3', '--quiet');
        const relit = read(folder.bytes('relit.probes'));
        const largest = largestOf(relit.irradiance);
        const positions = makePositions(volume, 500, 14);
        for (let i = 0; i < 500; ++i) {
            const position = positions.subarray(3 * i, 3 * i + 3);
            const [ours, theirs] = [volume, relit].map(v => v.light(position));
            ours.sh.forEach((value, k) => expect(Math.abs(value - theirs.sh[k])).toBeLessThan(1e-5 * largest));
            expect(ours.occlusion).toEqual(theirs.occlusion);
        }
        relit.ambient.forEach((value, k) => expect(volume.ambient[k]).toBeCloseTo(value, 4));
    });

    test('are dark when all are off, and as baked when all are on', () => {
        const baked = read(folder.bytes('volume.probes'));
        const all = (value: number) => Object.fromEntries(volume.layers.map(({name}) => [name, value]));
        volume.setWeights(all(0));
        expect(largestOf(volume.light([0, 1, 0]).sh)).toBe(0);
        volume.setWeights(all(1));
        volume.light([0, 1, 0]).sh.forEach((value, k) => expect(value).toBeCloseTo(baked.light([0, 1, 0]).sh[k], 4));
    });

    test('refuse names that no layer has, and weights that no light can have', () => {
        const code = (change: Record<string, number>) => {
            try {
                volume.setWeights(change);
            } catch (error) {
                return (error as TetralightError).code;
            }
            return 'none';
        };
        expect(code({lamp: 1})).toBe('not_found');
        for (const bad of [-1, NaN, Infinity, 1e38]) expect(code({sun: bad})).toBe('invalid_argument');
        expect(code({sun: 1})).toBe('none');
    });

    test('cannot change a volume without layers', () => {
        const plain = read(folder.bake([{name: 'a', positions: [[0, 1, 0]]}]));
        expect(plain.layers).toEqual([]);
        expect(() => plain.setWeights({})).toThrow('holds no layers');
    });
});
