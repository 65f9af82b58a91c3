// SPDX-License-Identifier: Apache-2.0
// Makes the files that the page reads, by the command: npm run gallery:input -- SCENE FOLDER
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join, resolve} from 'node:path';

import {irradiance, read, Volume} from '../src/index.js';
import {makeGlb, makeSphere} from './glb.js';
import type {Input} from './input.js';
import {eyeOf, kFieldOfView, kOverview, kRadius, kStations, Position} from './road.js';
import {kUncompressed} from './tone_mapping.js';

const kPictureSize = 256;

/** What the command has a white, rough dielectric reflect diffusely: 0.96, and half of the 4 % of its specular part. */
const kReflectivity = 0.98;

export function makeInput(command: string, scene: string, folder: string, ...bakeOptions: string[]): void {
    mkdirSync(folder, {recursive: true});
    const run = (...args: string[]) => {
        console.log(`tetralight ${args.join(' ')}`);
        execFileSync(command, args, {cwd: folder, stdio: ['ignore', 'ignore', 'inherit']});
    };
    run('bake', scene, '-o', 'court.probes', '--quiet', ...bakeOptions);
    const volume = read(new Uint8Array(readFileSync(join(folder, 'court.probes'))));
    const exposure = exposureOf(volume);
    run('render', scene, 'court.probes', '-o', 'overview.png', '--quiet', ...sizeAndCamera(kOverview));
    const input: Input = {exposure, overview: 'overview.png', stations: []};
    kStations.forEach(({position}, i) => {
        const picture = `ball_${i + 1}.png`;
        writeFileSync(join(folder, 'ball.glb'), makeBall(position));
        run('render', 'ball.glb', 'court.probes', '-o', picture, '--quiet', '--show', 'bounce', '--probes', 'one',
            '--exposure', String(exposure / kReflectivity), ...sizeAndCamera({
                eye: eyeOf(position), target: position, fieldOfView: kFieldOfView, width: kPictureSize, height: kPictureSize}));
        input.stations.push({position, picture});
    });
    writeFileSync(join(folder, 'gallery.json'), JSON.stringify(input, undefined, 4));
}

interface View {
    eye: readonly number[];
    target: readonly number[];
    fieldOfView: number;
    width: number;
    height: number;
}

function sizeAndCamera({eye, target, fieldOfView, width, height}: View): string[] {
    return ['--eye', eye.join(), '--target', target.join(), '--fov', String(fieldOfView),
            '--width', String(width), '--height', String(height)];
}

/** So that no color of a white ball is compressed. */
function exposureOf(volume: Volume): number {
    const {positions} = makeSphere(8);
    const brightest = Math.max(...kStations.flatMap(({position}) => {
        const {sh} = volume.light(position);
        return Array.from({length: positions.length / 3}, (_, i) =>
            Math.max(...irradiance(sh, positions.subarray(3 * i, 3 * i + 3))) / Math.PI);
    }));
    return 0.95 * kUncompressed / brightest;
}

function makeBall(position: Position): Uint8Array {
    const ball = makeSphere();
    return makeGlb({...ball, positions: ball.positions.map((x, i) => kRadius * x + position[i % 3])});
}

if (process.argv[1]?.endsWith('make_input.ts')) {
    const [scene, folder] = process.argv.slice(2);
    makeInput(process.env.TETRALIGHT_COMMAND ?? 'tetralight', resolve(scene), resolve(folder));
}
