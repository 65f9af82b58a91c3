// SPDX-License-Identifier: Apache-2.0
// Properties of locations and batches.
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {irradiance, kNone, packSh, read, Volume} from '../src/index.js';
import {Folder, kCommand, kCourtyard} from './command.js';
import {largestOf, makePositions, makeRandom} from './random.js';
import {kRooms, kSets} from './sets.js';

const folder = new Folder();
afterAll(() => folder.remove());

const hasCommand = kCommand !== '' && kCourtyard !== '';
const kCount = 500;

describe.skipIf(!hasCommand).each(Object.entries(kSets))('locations in set %s', (_, groups) => {
    let volume: Volume;
    let positions: Float32Array;
    const position = (i: number) => positions.subarray(3 * i, 3 * i + 3);
    beforeAll(() => {
        volume = read(folder.bake(groups));
        positions = makePositions(volume, kCount, 10);
    });

    test('have weights that are not negative and whose sum is 1', () => {
        for (const outside of ['extrapolate', 'clamp', 'ambient'] as const) {
            for (let i = 0; i < kCount; ++i) {
                const {weights, ambient} = volume.locate(position(i), kNone, {outside});
                expect(Math.min(...weights, ambient)).toBeGreaterThanOrEqual(0);
                expect(weights.reduce((sum, weight) => sum + weight, ambient)).toBeCloseTo(1, 6);
            }
        }
    });

    test('are on the probe where a position is on it', () => {
        for (let probe = 0; probe < volume.probeCount; ++probe) {
            // Queries take float positions: 0.03 m is their step at the set that is far away.
            const {probes, weights} = volume.locate(volume.position(probe));
            expect(weights[probes.indexOf(probe)]).toBeGreaterThan(0.999);
        }
    });

    test('do not depend on the hint, nor does light', () => {
        const random = makeRandom(11);
        const largest = largestOf(volume.irradiance);
        for (let i = 0; i < kCount; ++i) {
            const expected = volume.light(position(i)).sh;
            for (const hint of [0, Math.floor(random() * volume.cellCount), volume.cellCount, -1, NaN, 0.5 * 2 ** 40]) {
                const sh = volume.light(position(i), {hint}).sh;
                expect(largestOf(sh.map((value, k) => value - expected[k]))).toBeLessThan(1e-5 * largest);
            }
        }
    });

    test('of inner cells reproduce the position', () => {
        for (let i = 0; i < kCount; ++i) {
            const {cell, probes, weights} = volume.locate(position(i));
            if (volume.data.info.dimension < 4 || cell >= volume.data.info.innerCellCount) continue;
            for (let axis = 0; axis < 3; ++axis) {
                const {positions: local, info: {origin}} = volume.data;
                const sum = probes.reduce((total, probe, k) => total + weights[k] * local[3 * probe + axis], 0);
                expect(sum).toBeCloseTo(position(i)[axis] - origin[axis], 4);
            }
        }
    });
});

describe.skipIf(!hasCommand)('a batch', () => {
    let volume: Volume;
    let positions: Float32Array;
    beforeAll(() => {
        volume = read(folder.bake(kRooms));
        positions = makePositions(volume, kCount, 12);
        positions[5] = NaN;
    });

    test('has the answers of single queries', () => {
        const outputs = {sh: new Float32Array(27 * kCount), packed: new Float32Array(28 * kCount),
                         occlusion: new Float32Array(4 * kCount), hints: new Uint32Array(kCount).fill(kNone),
                         weights: new Float32Array(4 * kCount), ambient: new Float32Array(kCount)};
        volume.batch(positions, outputs, {outside: 'ambient'});
        for (let i = 0; i < kCount; ++i) {
            const position = positions.subarray(3 * i, 3 * i + 3);
            const light = volume.light(position, {outside: 'ambient'});
            const location = volume.locate(position, kNone, {outside: 'ambient'});
            expect(outputs.sh.subarray(27 * i, 27 * i + 27)).toEqual(light.sh);
            expect(outputs.occlusion.subarray(4 * i, 4 * i + 4)).toEqual(light.occlusion);
            expect(outputs.hints[i]).toBe(location.cell);
            expect(outputs.ambient[i]).toBe(Math.fround(location.ambient));
            location.weights.forEach((weight, k) => expect(outputs.weights[4 * i + k]).toBe(Math.fround(weight)));
            const packed = new Float32Array(28);
            packSh(light.sh, 0, packed, 0);
            packed.forEach((value, k) => expect(outputs.packed[28 * i + k]).toBeCloseTo(value, 5));
        }
    });

    test('begins its walks at the hints', () => {
        const [sh, again] = [new Float32Array(27 * kCount), new Float32Array(27 * kCount)];
        const hints = new Uint32Array(kCount).fill(kNone);
        volume.batch(positions, {sh, hints});
        const cells = hints.slice();
        volume.batch(positions, {sh: again, hints});
        expect(again).toEqual(sh);
        expect(hints).toEqual(cells);
    });

    test('has values of each position', () => {
        const radius = new Float32Array(kCount).map((_, i) => i % 3 * 0.4);
        const renderingLayers = new Uint32Array(kCount).map((_, i) => [1, 2, 0xffffffff][i % 3]);
        const normals = new Float32Array(3 * kCount).map((_, i) => [0, 0.6, 0.8][i % 3]);
        const sh = new Float32Array(27 * kCount);
        volume.batch(positions, {sh}, {radius, renderingLayers, normals});
        for (let i = 0; i < kCount; ++i) {
            const options = {radius: radius[i], renderingLayers: renderingLayers[i], normal: [0, normals[1], normals[2]]};
            const light = volume.light(positions.subarray(3 * i, 3 * i + 3), options);
            expect(sh.subarray(27 * i, 27 * i + 27)).toEqual(light.sh);
        }
    });

    test('refuses arrays that are too short, and options that cannot be', () => {
        const sh = new Float32Array(27 * kCount - 1);
        const error = (call: () => void) => {
            try {
                call();
            } catch (thrown) {
                return thrown as {code: string; field: string};
            }
            throw new Error('nothing was thrown');
        };
        const batch = (outputs: object, options = {}) => error(() => volume.batch(positions, outputs, options));
        expect(batch({sh})).toMatchObject({code: 'invalid_argument', field: 'sh'});
        expect(batch({}, {radius: [1]})).toMatchObject({code: 'invalid_argument', field: 'radius'});
        expect(batch({}, {radius: -1})).toMatchObject({code: 'invalid_argument', field: 'radius'});
        expect(batch({}, {normals: [1]})).toMatchObject({code: 'invalid_argument', field: 'normals'});
        expect(batch({}, {fadeDistance: 0})).toMatchObject({code: 'invalid_argument', field: 'fadeDistance'});
        expect(batch({}, {outside: 'far'})).toMatchObject({code: 'invalid_argument', field: 'outside'});
        expect(error(() => volume.batch([1, 2], {}))).toMatchObject({code: 'invalid_argument', field: 'positions'});
    });
});

test('irradiance of constant radiance is π, and of light from above falls off with the cosine', () => {
    // L = 1: L_0 = √(4π), E_0 = π L_0.
    const constant = new Float32Array(27).fill(Math.PI * Math.sqrt(4 * Math.PI), 0, 3);
    for (const normal of [[0, 1, 0], [0.6, 0, -0.8]]) {
        irradiance(constant, normal).forEach(value => expect(value).toBeCloseTo(Math.PI, 5));
    }
    // E(n) = 1 + y: E_0 Y_0 = 1, E_1 Y_1 = y.
    const fromAbove = new Float32Array(27);
    fromAbove.fill(2 * Math.sqrt(Math.PI), 0, 3).fill(2 * Math.sqrt(Math.PI / 3), 3, 6);
    expect(irradiance(fromAbove, [0, 1, 0])[0]).toBeCloseTo(2, 6);
    expect(irradiance(fromAbove, [1, 0, 0])[1]).toBeCloseTo(1, 6);
    expect(irradiance(fromAbove, [0, -1, 0])[2]).toBeCloseTo(0, 6);
});

test('packed coefficients give irradiance over π', () => {
    const random = makeRandom(13);
    const sh = Float32Array.from({length: 54}, () => random() - 0.5);
    const packed = new Float32Array(56);
    packSh(sh, 27, packed, 28);
    for (let i = 0; i < 20; ++i) {
        const [a, b, c] = [random() - 0.5, random() - 0.5, random() - 0.5];
        const length = Math.hypot(a, b, c);
        const [x, y, z] = [a / length, b / length, c / length];
        const expected = irradiance(sh, [x, y, z], 27);
        for (let channel = 0; channel < 3; ++channel) {
            const dot = (at: number, v: number[]) => v.reduce((sum, value, k) => sum + value * packed[at + k], 0);
            const sum = dot(28 + 4 * channel, [x, y, z, 1]) + dot(40 + 4 * channel, [x * y, y * z, z * z, z * x]) +
                        packed[52 + channel] * (x * x - y * y);
            expect(sum).toBeCloseTo(expected[channel] / Math.PI, 5);
        }
    }
});
