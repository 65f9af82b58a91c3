// SPDX-License-Identifier: Apache-2.0
// Queries against answers of the command.
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {kNone, QueryOptions, read, Volume} from '../src/index.js';
import {Answer, Folder, kCommand, kCourtyard} from './command.js';
import {largestOf, makePositions} from './random.js';
import {kRooms, kSets} from './sets.js';

const folder = new Folder();
afterAll(() => folder.remove());

const hasCommand = kCommand !== '' && kCourtyard !== '';

/** Largest difference of a coefficient over the largest coefficient, and of occlusion and the ambient fraction. */
function largestError(volume: Volume, positions: Float32Array, answers: readonly Answer[], options: QueryOptions): number {
    const largest = Math.max(largestOf(answers.flatMap(answer => answer.irradiance_sh.flat())), 1e-30);
    let error = 0;
    answers.forEach((answer, i) => {
        const light = volume.light(positions.subarray(3 * i, 3 * i + 3), options);
        answer.irradiance_sh.flat().forEach((value, k) => {
            error = Math.max(error, Math.abs(value - light.sh[k]) / largest);
        });
        answer.occlusion.forEach((value, k) => {
            error = Math.max(error, Math.abs(value - light.occlusion[k]));
        });
        error = Math.max(error, Math.abs(answer.ambient - light.ambient));
    });
    return error;
}

function check(volume: Volume, options: QueryOptions, count: number, ...flags: string[]): void {
    const positions = makePositions(volume, count, 7);
    const answers = folder.query(positions, ...flags);
    expect(answers).toHaveLength(count);
    expect(largestError(volume, positions, answers, options)).toBeLessThan(1e-5);
}

describe.skipIf(!hasCommand).each(Object.entries(kSets))('light of the probes of set %s', (_, groups) => {
    let volume: Volume;
    beforeAll(() => { volume = read(folder.bake(groups)); });

    test('is that of the command', () => check(volume, {}, 2000));

    test('is that of the command with each policy outside the hull', () => {
        check(volume, {outside: 'clamp'}, 1000, '--outside', 'clamp');
        check(volume, {outside: 'ambient', fadeDistance: 3}, 1000, '--outside', 'ambient', '--fade', '3');
    });

    test('is that of the command for objects of a size, and without walls', () => {
        check(volume, {radius: 0.5}, 1000, '--radius', '0.5');
        check(volume, {walls: 'ignore'}, 1000, '--walls', 'ignore');
    });
});

describe.skipIf(!hasCommand)('the courtyard', () => {
    let volume: Volume;
    beforeAll(() => { volume = read(folder.bake(undefined)); });

    test('has walls, and the light of the command', () => {
        expect(volume.data.cellVisibility.length).toBeGreaterThan(0);
        check(volume, {}, 5000);
        check(volume, {radius: 0.3}, 2000, '--radius', '0.3');
    });

    test('has cells and weights of the command, but for ties', () => {
        const positions = makePositions(volume, 1000, 8);
        const answers = folder.query(positions);
        let sameCount = 0;
        answers.forEach((answer, i) => {
            const light = volume.light(positions.subarray(3 * i, 3 * i + 3));
            if (answer.cell !== light.cell) return;
            ++sameCount;
            expect(light.probes).toEqual(answer.probes.map(({probe}) => probe));
            light.weights.forEach((weight, k) => expect(weight).toBeCloseTo(answer.probes[k].weight, 5));
        });
        expect(sameCount).toBeGreaterThan(0.9 * answers.length);
    });

    test('lights surfaces as the command does', () => {
        const positions = makePositions(volume, 500, 9);
        const normals = positions.map((_, i) => [0.6, 0.8, 0][i % 3]);
        const rows = new Float32Array(2 * positions.length);
        for (let i = 0; i < 500; ++i) {
            rows.set(positions.subarray(3 * i, 3 * i + 3), 6 * i);
            rows.set(normals.subarray(3 * i, 3 * i + 3), 6 * i + 3);
        }
        const answers = folder.query(rows, '--normals', '--normal-offset', '0.2');
        const options = {normal: [0.6, 0.8, 0], normalOffset: 0.2};
        expect(largestError(volume, positions, answers, options)).toBeLessThan(1e-5);
    });

    test('gives ambient light where a position is not finite', () => {
        for (const bad of [NaN, Infinity, -Infinity]) {
            const light = volume.light([0, bad, 0]);
            expect([light.cell, light.ambient, light.probes]).toEqual([kNone, 1, []]);
            expect(light.sh).toEqual(volume.ambient);
            expect([...light.occlusion]).toEqual([1, 1, 1, 1]);
        }
    });
});

test.skipIf(!hasCommand)('objects take light of probes on their rendering layers', () => {
    const volume = read(folder.bake(kRooms));
    check(volume, {renderingLayers: 1}, 1000, '--rendering-layers', '0');
    check(volume, {renderingLayers: 6}, 1000, '--rendering-layers', '1,2');
});

test.skipIf(!hasCommand)('occlusion of a shadowmask is that of the command', () => {
    const volume = read(folder.bake(kSets.scattered, '--mixed-lighting', 'shadowmask'));
    const occluded = volume.data.occlusion.filter(value => value < 1);
    expect(occluded.length).toBeGreaterThan(0);
    expect(volume.lights.map(light => [light.type, light.mode, light.mixedLighting, light.channel])).toEqual(
        [['directional', 'mixed', 'shadowmask', 0]]);
    check(volume, {}, 1000);
});

test.skipIf(!hasCommand)('without probes all light is ambient', () => {
    const volume = read(folder.bake([]));
    expect([volume.probeCount, volume.cellCount]).toEqual([0, 0]);
    expect(volume.light([1, 2, 3]).sh).toEqual(volume.ambient);
    expect(volume.locate([1, 2, 3])).toEqual({cell: kNone, probes: [], weights: [], ambient: 1});
});

test.skipIf(!hasCommand)('without baked light all light is ambient', () => {
    const volume = read(folder.tetrahedralize(kSets.scattered));
    expect(volume.irradiance).toHaveLength(0);
    expect(volume.light([0, 1, 0]).sh).toEqual(volume.ambient);
    expect(volume.locate([0, 1, 0]).probes).toHaveLength(4);
});

test.skipIf(!hasCommand)('what is not a position, a normal or a probe is refused by name', () => {
    const volume = read(folder.tetrahedralize(kSets.scattered));
    const bad = (value: unknown) => value as [number, number, number];
    for (const position of [[1, 2], 'abc', {}, [undefined, 1, 2], undefined]) {
        expect(() => volume.light(bad(position))).toThrow('position is not three numbers');
        expect(() => volume.locate(bad(position))).toThrow('position is not three numbers');
    }
    expect(() => volume.light([0, 0, 0], {normal: bad([1, 2])})).toThrow('normal is not three numbers: [1,2]');
    for (const probe of [-1, 1.5, volume.probeCount]) {
        expect(() => volume.position(probe)).toThrow(`probe ${probe} is not one of ${volume.probeCount}`);
    }
    expect(() => volume.batch(undefined as unknown as Float32Array, {})).toThrow('positions is not an array');
    // As in the library, no place is lit by the ambient light.
    expect(volume.light([NaN, 0, 0]).cell).toBe(kNone);
});
