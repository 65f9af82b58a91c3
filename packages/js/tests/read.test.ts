// SPDX-License-Identifier: Apache-2.0
// Files that must not be read, and how others are.
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {read} from '../src/index.js';
import {Folder, kCommand, kCourtyard} from './command.js';
import {makeRandom} from './random.js';
import {Entry, errorOf as errorOfCall, sectionsOf, sign} from './sections.js';
import {kSets} from './sets.js';

const folder = new Folder();
afterAll(() => folder.remove());

const hasCommand = kCommand !== '' && kCourtyard !== '';

const errorOf = (bytes: Uint8Array) => errorOfCall(() => read(bytes));

describe.skipIf(!hasCommand)('a file', () => {
    let bytes: Uint8Array;
    beforeAll(() => {
        bytes = folder.bake([{name: 'a', positions: [[0, 1, 0], [2, 1, 0], [0, 3, 0], [0, 1, 2], [-2, 1, -2]]}],
                            '--layers', 'sun,sky', '--mixed-lighting', 'shadowmask');
    });

    test('is refused when it is cut off anywhere', () => {
        for (let length = 0; length < bytes.length; ++length) {
            expect(errorOf(bytes.slice(0, length))?.code).toBe('corrupt');
        }
        expect(errorOf(new Uint8Array([...bytes, 0]))?.code).toBe('corrupt');
    });

    test('is refused when any of its bytes changes', () => {
        const random = makeRandom(20);
        const changed = bytes.slice();
        for (let i = 0; i < bytes.length; ++i) {
            changed[i] ^= 1 << Math.floor(8 * random());
            expect(errorOf(changed), `byte ${i}`).toBeDefined();
            changed[i] = bytes[i];
        }
        expect(errorOf(changed)).toBeUndefined();
    });

    test('with right checksums and any wrong value is refused, or gives light that is finite', () => {
        const random = makeRandom(21);
        const sections = sectionsOf(bytes);
        let refusedCount = 0;
        const kRounds = 3000;
        for (let round = 0; round < kRounds; ++round) {
            const changed = bytes.slice();
            const section = sections[Math.floor(sections.length * random())];
            for (let k = 0; k < 1 + 3 * random(); ++k) {
                changed[section.offset + Math.floor(section.size * random())] = 256 * random();
            }
            sign(changed, section);
            const error = errorOf(changed);
            if (error) {
                ++refusedCount;
                expect(error.message).toMatch(/^section "\w+": /);
                continue;
            }
            const volume = read(changed);
            for (let i = 0; i < 10; ++i) {
                const position = [8 * random() - 4, 8 * random() - 4, 8 * random() - 4];
                const light = volume.light(position, {radius: random()});
                expect(light.sh.every(Number.isFinite), section.name).toBe(true);
            }
        }
        expect(refusedCount).toBeGreaterThan(kRounds / 4);
    });

    test('is refused with the section and the element that are wrong', () => {
        const change = (name: string, use: (view: DataView) => void) => {
            const changed = bytes.slice();
            const section = sectionsOf(changed).find(entry => entry.name === name) as Entry;
            use(new DataView(changed.buffer, section.offset, section.size));
            sign(changed, section);
            return errorOf(changed);
        };
        const word = (offset: number, value: number) => (view: DataView) => view.setUint32(offset, value, true);
        const float = (offset: number, value: number) => (view: DataView) => view.setFloat32(offset, value, true);
        expect(change('cells', word(0, 99))).toMatchObject({field: 'cells[0]', code: 'corrupt'});
        expect(change('cells', word(0, 99))?.message).toBe('section "cells": element 0: vertex 99 is out of range (5)');
        expect(change('cells', word(16, 99))?.message).toContain('neighbor 99 is out of range');
        expect(change('cells', word(16, 1))?.message).toMatch(/not its neighbor|twice/);
        expect(change('positions', float(12, NaN))).toMatchObject({field: 'positions[1]'});
        expect(change('irradiance', float(2 * 108, Infinity))).toMatchObject({field: 'irradiance[2]'});
        expect(change('occlusion', float(16, 1.5))).toMatchObject({field: 'occlusion[1]'});
        expect(change('hull_rays', float(0, 2))).toMatchObject({field: 'hull_rays[0]'});
        expect(change('layers', float(128, -1))).toMatchObject({field: 'layers[1]'});
        expect(change('info', word(80, 3))?.message).toContain('dimension 3');
        expect(change('info', float(200, 1e6))?.message).toContain('extent');
        expect(change('layer_names', view => view.setUint8(0, 0xff))?.message).toContain('is not UTF-8');
        expect(change('seed_grid', word(40, 0x7fffffff))?.message).toContain('out of range');
    });

    test('of another version or kind is refused', () => {
        const changed = bytes.slice();
        changed[8] = 2;
        expect(errorOf(changed)).toMatchObject({code: 'unsupported', field: 'version'});
        changed[0] = 0;
        expect(errorOf(changed)?.message).toBe('not a probe file (wrong first bytes)');
        expect(() => read('text' as unknown as ArrayBuffer)).toThrow('neither an ArrayBuffer nor a view');
    });

    test('is the same in any buffer and at any offset', () => {
        const expected = read(bytes).light([0, 1.5, 0.5]);
        const shared = new Uint8Array(new SharedArrayBuffer(bytes.length));
        shared.set(bytes);
        const shifted = new Uint8Array(bytes.length + 3);
        shifted.set(bytes, 3);
        for (const data of [bytes.buffer, shared, shared.buffer, shifted.subarray(3), new DataView(shifted.buffer, 3)]) {
            expect(read(data as ArrayBuffer).light([0, 1.5, 0.5])).toEqual(expected);
        }
    });

    test('in a shared or resizable buffer is copied: later changes do not reach it', () => {
        const expected = read(bytes).light([0, 1.5, 0.5]);
        const buffers: (ArrayBuffer | SharedArrayBuffer)[] = [new SharedArrayBuffer(bytes.length)];
        const Resizable = ArrayBuffer as unknown as new(length: number, options: object) => ArrayBuffer;
        const resizable = new Resizable(bytes.length, {maxByteLength: 2 * bytes.length});
        if ((resizable as {resizable?: boolean}).resizable) buffers.push(resizable);
        for (const buffer of buffers) {
            const view = new Uint8Array(buffer);
            view.set(bytes);
            const volume = read(buffer);
            view.fill(0xff);
            expect(volume.light([0, 1.5, 0.5])).toEqual(expected);
        }
    });

    test('with halves alone has light of half precision', () => {
        const full = read(bytes);
        // The name of the section changes, and readers skip sections that they do not know.
        const changed = bytes.slice();
        for (const name of ['irradiance', 'occlusion']) {
            const section = sectionsOf(changed).find(entry => entry.name === name) as Entry;
            changed[section.at] = 'x'.charCodeAt(0);
            sign(changed, section);
        }
        const halves = read(changed);
        expect(read(bytes, {precision: 'half'}).irradiance).toEqual(halves.irradiance);
        expect(halves.irradiance).toHaveLength(full.irradiance.length);
        halves.irradiance.forEach((value, k) => {
            expect(Math.abs(value - full.irradiance[k])).toBeLessThanOrEqual(2 ** -11 * Math.abs(full.irradiance[k]) + 1e-6);
        });
        const [a, b] = [halves, full].map(volume => volume.light([0, 1.5, 0.5]).occlusion);
        a.forEach((value, k) => expect(value).toBeCloseTo(b[k], 3));
    });
});

test.skipIf(!hasCommand)('checksums of sections of many lengths are those of the library', () => {
    // The name of the group and a line break are the bytes of section `group_names`.
    const lengths = [1, 2, 3, 4, 7, 8, 9, 15, 16, 17, 31, 32, 33, 63, 64, 65, 95, 96, 97, 127, 128, 129, 143, 144, 145, 191,
                     239, 240, 241, 255, 256, 257, 319, 320, 321, 1023, 1024, 1025, 1087, 1088, 1089, 2048, 2049, 5000];
    for (const length of lengths) {
        const name = 'n'.repeat(Math.max(length - 1, 1));
        const volume = read(folder.tetrahedralize([{name, positions: [[0, 0, 0], [1, 0, 0]]}]));
        expect(volume.data.groupNames).toEqual([name]);
    }
});

test.skipIf(!hasCommand)('names in all scripts are read and sorted by code points', () => {
    const names = ['Häuser', 'ￚ', '😀', 'a'];
    const volume = read(folder.tetrahedralize(names.map((name, i) => ({name, positions: [[i, 0, 0]]}))));
    expect(volume.data.groupNames).toEqual(['Häuser', 'a', 'ￚ', '😀']);
});

test.skipIf(!hasCommand)('metadata and lights are those of the bake', () => {
    const volume = read(folder.bake(kSets.point));
    expect(JSON.parse(volume.data.metadata)).toMatchObject({samples: 4});
    expect(volume.lights).toHaveLength(1);
    expect(volume.lights[0]).toMatchObject({name: 'sun', type: 'directional', mode: 'mixed', range: 0});
    expect(Math.hypot(...volume.lights[0].direction)).toBeCloseTo(1, 5);
});
