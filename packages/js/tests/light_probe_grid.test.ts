// SPDX-License-Identifier: Apache-2.0
// Grids of three.js: those of the command and those of this package.
import {Box3, Vector3} from 'three';
import {afterAll, describe, expect, test} from 'vitest';

import {read} from '../src/index.js';
import {GridFile, readLightProbeGrid, toLightProbeGrid} from '../src/three/index.js';
import {Folder, kCommand, kCourtyard} from './command.js';
import {largestOf} from './random.js';

const folder = new Folder();
afterAll(() => folder.remove());

describe.skipIf(kCommand === '' || kCourtyard === '')('a grid of `tetralight export`', () => {
    const exported = () => {
        const volume = read(folder.bake(undefined));
        folder.run('export', 'volume.probes', '--as', 'three-grid', '--resolution', '5,3,4', '--bounds', '-6,0,-5,6,4,5',
                   '-o', 'grid.json', '--quiet');
        const file = JSON.parse(new TextDecoder().decode(folder.bytes('grid.json'))) as GridFile;
        return {volume, file, data: folder.bytes(file.data).slice().buffer};
    };

    test('is the grid that this package makes', () => {
        const {volume, file, data} = exported();
        const theirs = readLightProbeGrid(file, data);
        const ours = toLightProbeGrid(volume, new Box3(new Vector3(-6, 0, -5), new Vector3(6, 4, 5)), [5, 3, 4]);
        expect(theirs.boundingBox).toEqual(ours.boundingBox);
        expect(theirs.resolution).toEqual(ours.resolution);
        const [a, b] = [theirs, ours].map(grid => grid.texture!.image);
        expect([a.width, a.height, a.depth]).toEqual([b.width, b.height, b.depth]);
        expect([a.width, a.height, a.depth]).toEqual(file.texture);
        const [texels, wanted] = [a, b].map(image => image.data as Float32Array);
        const largest = largestOf(wanted);
        expect(largest).toBeGreaterThan(0);
        texels.forEach((value, i) => expect(Math.abs(value - wanted[i])).toBeLessThan(1e-5 * largest));
    });

    test('is refused if the texture is cut off', () => {
        const {file, data} = exported();
        expect(() => readLightProbeGrid(file, data.slice(0, -1))).toThrow('data has 10079 bytes instead of 10080');
    });

    test('of a volume has whole numbers of cells, and a box', () => {
        const volume = read(folder.bake(undefined));
        const box = new Box3(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
        for (const resolution of [[0, 2, 2], [1.5, 2, 2], [2048, 2048, 2]] as [number, number, number][]) {
            expect(() => toLightProbeGrid(volume, box, resolution)).toThrow(`resolution is (${resolution.join(', ')})`);
        }
        expect(() => toLightProbeGrid(volume, new Box3(), [1, 1, 1])).toThrow('box is empty');
    });
});
