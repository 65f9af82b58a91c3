// SPDX-License-Identifier: Apache-2.0
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {irradiance, levelRoughness, readReflections, Reflections} from '../src/index.js';
import {floatOfHalf} from '../src/half.js';
import {Folder, kCommand, kCourtyard} from './command.js';
import {largestOf, makeRandom} from './random.js';
import {errorOf} from './sections.js';

const folder = new Folder();
afterAll(() => folder.remove());

interface ProbeJson {
    position: number[];
    box: {center: number[]; half_size: number[]; axes: number[][]} | null;
    blend_distance: number;
    importance: number;
    validity: number;
    irradiance_sh: number[][];
}

describe.skipIf(kCommand === '' || kCourtyard === '')('reflection probes', () => {
    let bytes: Uint8Array;
    let reflections: Reflections;
    beforeAll(() => {
        folder.run('reflect', kCourtyard, '--box', '-4,0,-4,4,3,4', '-o', 'level.ktx2', '--cube-size', '16', '--samples', '4',
                   '--layers', 'sun,sky', '--quiet');
        bytes = folder.bytes('level.ktx2');
        reflections = readReflections(bytes);
    });

    /** The JSON that the file has for programs that do not read its structs. */
    function json(): {probes: ProbeJson[]; roughness: number[]; layers: object[]} {
        const text = new TextDecoder().decode(bytes);
        const begin = text.indexOf('{"version"');
        return JSON.parse(text.slice(begin, text.indexOf('\0', begin))) as ReturnType<typeof json>;
    }

    test('have the numbers of the JSON in their file', () => {
        const {probes, roughness, layers} = json();
        expect(reflections.probes).toHaveLength(probes.length);
        reflections.probes.forEach((probe, i) => {
            const {box, position, blend_distance, importance, validity, irradiance_sh} = probes[i];
            expect(probe.position).toEqual(position);
            expect([probe.blendDistance, probe.importance]).toEqual([Math.fround(blend_distance), importance]);
            expect(probe.validity).toBeCloseTo(validity, 5);
            irradiance_sh.flat().forEach((value, k) => expect(probe.sh[k]).toBeCloseTo(value, 4));
            expect(probe.halfSize.every(Number.isFinite)).toBe(box !== null);
            if (box === null) return;
            [...box.center, ...box.half_size, ...box.axes.flat()].forEach((value, k) => {
                expect([...probe.boxCenter, ...probe.halfSize, ...probe.axes][k]).toBeCloseTo(value, 5);
            });
        });
        expect(reflections.layers.map(({name, weight}) => ({name, weight}))).toEqual(layers);
        roughness.forEach((value, level) => {
            expect(levelRoughness(level, reflections.levelCount)).toBeCloseTo(value, 5);
        });
    });

    test('are the sum of their layers', () => {
        for (let level = 0; level < reflections.levelCount; ++level) {
            const cubes = reflections.layers.map((_, layer) => reflections.texels(0, level, layer));
            const own = reflections.texels(0, level);
            expect(own).toHaveLength(4 * 6 * (16 >> level) ** 2);
            const light = Array.from(own, half => floatOfHalf(half));
            const largest = largestOf(light);
            light.forEach((value, i) => {
                const sum = cubes.reduce((total, cube) => total + floatOfHalf(cube[i]), 0);
                expect(i % 4 === 3 ? 1 : sum).toBeGreaterThan(value * 0.99 - 1e-3 * largest);
                expect(i % 4 === 3 ? 1 : sum).toBeLessThan(value * 1.01 + 1e-3 * largest);
            });
        }
    });

    test('have irradiance that is positive and the sum of that of layers', () => {
        const count = reflections.layers.length;
        reflections.probes.forEach(({sh}, probe) => {
            irradiance(sh, [0, 1, 0]).forEach(value => expect(value).toBeGreaterThan(0));
            sh.forEach((value, k) => {
                const parts = Array.from({length: count}, (_, i) => reflections.layerIrradiance[27 * (probe * count + i) + k]);
                expect(parts.reduce((sum, part) => sum + part, 0)).toBeCloseTo(value, 2);
            });
        });
    });

    test('are refused when they are cut off', () => {
        for (let length = 0; length < bytes.length; length += 1 + Math.floor(length / 100)) {
            expect(errorOf(() => readReflections(bytes.slice(0, length)))?.code, `${length} bytes`).toBe('corrupt');
        }
    });

    test('with any byte changed are refused, or are sound', () => {
        const random = makeRandom(40);
        const head = bytes.length - 8 * 6 * 16 * 16;
        for (let i = 0; i < 1500; ++i) {
            const changed = bytes.slice();
            changed[Math.floor((i % 4 === 0 ? bytes.length : Math.min(head, 3000)) * random())] = 256 * random();
            let sound: Reflections | undefined;
            if (errorOf(() => { sound = readReflections(changed); }) || !sound) continue;
            for (const [probe, {sh}] of sound.probes.entries()) {
                expect(sh.every(Number.isFinite)).toBe(true);
                expect(sound.texels(probe, 0)).toHaveLength(4 * 6 * sound.size ** 2);
            }
        }
    });

    test('of another kind are refused', () => {
        const changed = (at: number, value: number) => {
            const copy = bytes.slice();
            new DataView(copy.buffer).setUint32(at, value, true);
            return errorOf(() => readReflections(copy));
        };
        expect(changed(0, 0)).toMatchObject({code: 'corrupt', message: 'not a KTX 2.0 file (wrong first bytes)'});
        expect(changed(12, 109)).toMatchObject({code: 'unsupported', field: 'vk_format'});
        expect(changed(36, 1)).toMatchObject({code: 'unsupported', field: 'face_count'});
        expect(changed(44, 2)).toMatchObject({code: 'unsupported', field: 'supercompression'});
        expect(changed(20, 17)).toMatchObject({code: 'corrupt', field: 'size'});
        expect(changed(40, 30)).toMatchObject({code: 'corrupt', field: 'level_count'});
        expect(changed(80, 1)).toMatchObject({code: 'corrupt', field: 'levels[0]'});
        expect(errorOf(() => reflections.texels(99, 0))).toMatchObject({code: 'invalid_argument', field: 'probe'});
    });
});
