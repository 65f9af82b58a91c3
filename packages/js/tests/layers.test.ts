// SPDX-License-Identifier: Apache-2.0
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {constantSky, read, TetralightError, Volume} from '../src/index.js';
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

    describe.each([['as baked', []], ['without ringing', ['--dering']], ['with a window', ['--dering', '--dering-window', 'hann']]])(
        'with a transfer, %s', (_, options) => {
            let baked: Uint8Array;
            beforeAll(() => { baked = folder.bake(undefined, '--layers', 'sun,sky,emission,transfer', ...options); });

            /** Compares with what the command makes of the same bake. */
            const expectAsCommand = (volume: Volume, ...args: string[]) => {
                folder.run('relight', 'volume.probes', '-o', 'relit.probes', ...args, '--quiet');
                const relit = read(folder.bytes('relit.probes'));
                const largest = largestOf(relit.irradiance);
                volume.irradiance.forEach((value, i) =>
                    expect(Math.abs(value - relit.irradiance[i])).toBeLessThan(1e-5 * largest));
                volume.ambient.forEach((value, i) => expect(Math.abs(value - relit.ambient[i])).toBeLessThan(1e-5 * largest));
                expect(volume.lights.map(({channel}) => channel)).toEqual(relit.lights.map(({channel}) => channel));
                volume.lights.forEach(({direction, intensity}, i) => [...direction, ...intensity].forEach((value, k) =>
                    expect(value).toBeCloseTo([...relit.lights[i].direction, ...relit.lights[i].intensity][k], 5)));
            };

            test('another sky gives the light of `tetralight relight`', () => {
                const volume = read(baked);
                volume.relightSky(constantSky([0.5, 2, 7]));
                expectAsCommand(volume, '--sky', '0.5,2,7');
                volume.setWeights({sky: 0.5, sun: 0});
                expectAsCommand(volume, '--sky', '0.5,2,7', '--weights', 'sky=0.5,sun=0');
            });

            test('a sun that moves gives the light of `tetralight relight`', () => {
                const volume = read(baked);
                volume.relightSun([0.3, -2, 1], [4, 3, 1]);
                expectAsCommand(volume, '--sun-direction', '0.3,-2,1', '--sun-irradiance', '4,3,1');
                volume.relightSky(constantSky([1, 1, 1]));
                expectAsCommand(volume, '--sun-direction', '0.3,-2,1', '--sun-irradiance', '4,3,1', '--sky', '1');
            });

            test('the file stays as it is', () => {
                const before = baked.slice();
                const volume = read(baked);
                volume.relightSky(constantSky([9, 9, 9]));
                volume.relightSun([0, -1, 0], [9, 9, 9]);
                expect(Buffer.compare(baked, before)).toBe(0);
            });
        });

    test('refuse skies and suns that no light can have, and volumes without a transfer', () => {
        const plain = read(folder.bake(undefined, '--layers', 'sun,sky'));
        expect(() => plain.relightSky(constantSky([1, 1, 1]))).toThrow('transfer is missing');
        const full = read(folder.bake(undefined, '--layers', 'sky,transfer'));
        expect(() => full.relightSky([1, 2, 3])).toThrow('sky has 3 numbers instead of 48');
        expect(() => full.relightSky(constantSky([NaN, 1, 1]))).toThrow('sky is not finite: number 0 is NaN');
        expect(() => full.relightSun([0, -1, 0], [1, 1, 1])).toThrow('no layer "sun"');
        const moving = read(folder.bake(undefined, '--layers', 'sun,sky,transfer'));
        expect(() => moving.relightSun([0, 0, 0], [1, 1, 1])).toThrow('direction is (0, 0, 0)');
        expect(() => moving.relightSun([0, -1, 0], [Infinity, 1, 1])).toThrow('irradiance is not finite');
        expect(() => moving.relightSun([0, -1, 0], [-1, 1, 1])).toThrow('irradiance is (-1, 1, 1); 0 or more is possible');
        expect(() => constantSky([1, 2])).toThrow('radiance is not three numbers');
    });

    test('cannot change a volume without layers', () => {
        const plain = read(folder.bake([{name: 'a', positions: [[0, 1, 0]]}]));
        expect(plain.layers).toEqual([]);
        expect(() => plain.setWeights({})).toThrow('holds no layers');
    });
});
