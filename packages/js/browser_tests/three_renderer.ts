// SPDX-License-Identifier: Apache-2.0
// Pictures of spheres by `tetralight render`, and what differs in those of three.js.
import {readFileSync, writeFileSync} from 'node:fs';
import {inflateSync} from 'node:zlib';

import {SphereGeometry} from 'three';
import {expect} from 'vitest';

import type {LitSquares} from './three_browser.js';
import {Kind, kAlbedo, kRadius, kSphereSize, kView} from './three_squares.js';

/** A glTF file with a grey sphere at each place, which moves and so takes its light from the probes. */
function sphereScene(places: readonly (readonly number[])[]): string {
    const {attributes: {position, normal}, index} = new SphereGeometry(kRadius, 80, 48);
    const parts = [position.array, normal.array, index!.array].map(array => Buffer.from(new Uint8Array(array.buffer)));
    const corner = {componentType: 5126, count: position.count, type: 'VEC3'};
    let at = 0;  // the end of the last part
    return JSON.stringify({
        asset: {version: '2.0'}, scene: 0, scenes: [{nodes: places.map((_, i) => i)}],
        nodes: places.map(place => ({mesh: 0, translation: place, extras: {contribute_gi: false}})),
        meshes: [{primitives: [{attributes: {POSITION: 0, NORMAL: 1}, indices: 2, material: 0}]}],
        materials: [{pbrMetallicRoughness: {baseColorFactor: [kAlbedo, kAlbedo, kAlbedo, 1], metallicFactor: 0}}],
        accessors: [
            {...corner, bufferView: 0, min: [-kRadius, -kRadius, -kRadius], max: [kRadius, kRadius, kRadius]},
            {...corner, bufferView: 1},
            {bufferView: 2, componentType: index!.array.BYTES_PER_ELEMENT === 2 ? 5123 : 5125, count: index!.count, type: 'SCALAR'}],
        bufferViews: parts.map(({length}) => ({buffer: 0, byteOffset: (at += length) - length, byteLength: length})),
        buffers: [{byteLength: at, uri: `data:application/octet-stream;base64,${Buffer.concat(parts).toString('base64')}`}],
    });
}

/** RGB of a PNG of 8 bits without interlacing (ISO/IEC 15948, 9.2). */
function readPng(png: Buffer): {rgb: number[][]} {
    const width = png.readUInt32BE(16);
    const channels = png[25] === 6 ? 4 : 3;
    const data: Buffer[] = [];
    for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
        if (png.toString('latin1', at + 4, at + 8) === 'IDAT') data.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
    }
    const bytes = inflateSync(Buffer.concat(data));
    const row = channels * width;
    const out = new Uint8Array(bytes.length / (row + 1) * row);
    for (let i = 0; i < out.length; ++i) {
        const line = Math.floor(i / row);
        const left = i % row >= channels ? out[i - channels] : 0;
        const up = line > 0 ? out[i - row] : 0;
        const corner = line > 0 && i % row >= channels ? out[i - row - channels] : 0;
        const guess = left + up - corner;
        const [a, b, c] = [left, up, corner].map(value => Math.abs(guess - value));
        const paeth = a <= b && a <= c ? left : b <= c ? up : corner;
        out[i] = bytes[i + line + 1] + [0, left, up, Math.floor((left + up) / 2), paeth][bytes[line * (row + 1)]];
    }
    return {rgb: Array.from({length: out.length / channels}, (_, i) => [...out.subarray(channels * i, channels * i + 3)])};
}

/** The pictures of all squares without lights that are not baked, RGB of each pixel. */
export function renderSpheres({folder, squares}: LitSquares, exposure: number): number[][][] {
    writeFileSync(folder.file('spheres.gltf'), sphereScene(squares.map(({position}) => position)));
    return squares.map(({position, normal}) => {
        const eye = position.map((x, i) => x + kView.distance * normal[i]);
        folder.run('render', 'spheres.gltf', 'volume.probes', '-o', 'sphere.png', '--quiet', '--antialias', '1',
                   '--width', `${kSphereSize}`, '--height', `${kSphereSize}`, '--exposure', `${exposure}`, '--probes', 'one',
                   '--show', 'bounce',
                   `--eye=${eye.join(',')}`, `--target=${position.join(',')}`, '--fov', `${kView.fov}`);
        return readPng(readFileSync(folder.file('sphere.png'))).rgb;
    });
}

/** The largest difference of pixels well within the spheres, of 255. */
function largestDifference(ours: number[][][], theirs: number[][]): number {
    const apparent = Math.tan(Math.asin(kRadius / kView.distance)) / Math.tan(kView.fov * Math.PI / 360);
    let largest = 0;
    expect(theirs).toHaveLength(ours.length);
    theirs.forEach((picture, i) => {
        for (let k = 0; k < kSphereSize ** 2; ++k) {
            const [x, y] = [k % kSphereSize, Math.floor(k / kSphereSize)].map(c => 2 * (c + 0.5) / kSphereSize - 1);
            if (Math.hypot(x, y) > 0.95 * apparent) continue;
            for (let channel = 0; channel < 3; ++channel) {
                largest = Math.max(largest, Math.abs(ours[i][k][channel] - picture[4 * k + channel]));
            }
        }
    });
    return largest;
}

/** Its surfaces are diffuse: standard materials of three.js are darker towards the rim. */
export function compareWithRenderer(kind: Kind, ours: number[][][], theirs: number[][]): void {
    const largest = largestDifference(ours, theirs);
    if (process.env.TETRALIGHT_PRINT) console.log(`${kind} spheres beside tetralight render: ${largest} of 255`);
    expect(largest).toBeLessThanOrEqual(kind === 'standard' ? 5 : 2);
}
