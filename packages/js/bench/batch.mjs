// SPDX-License-Identifier: Apache-2.0
// node batch.mjs FOLDER full|half: the time that a batch takes in Node, and how far its answers are from those of the
// folder: volume.probes, positions.f32, answers.f32. Prints a JSON object.
import {readFileSync} from 'node:fs';
import {join} from 'node:path';

import {read} from '../dist/index.js';

const kRuns = 5;
const kCoefficients = 27;
const [folder, precision] = process.argv.slice(2);

function bytes(name) {
    const file = readFileSync(join(folder, name));
    return file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
}

function largest(values) {
    let found = 0;
    for (const value of values) found = Math.max(found, Math.abs(value));
    return found;
}

const volume = read(bytes('volume.probes'), {precision});
const positions = new Float32Array(bytes('positions.f32'));
const expected = new Float32Array(bytes('answers.f32'));
const sh = new Float32Array(positions.length / 3 * kCoefficients);
const times = [];
for (let run = 0; run < kRuns; ++run) {
    const start = performance.now();
    volume.batch(positions, {sh});
    times.push((performance.now() - start) / 1000);
}
times.sort((a, b) => a - b);
const difference = largest(sh.map((value, i) => value - expected[i])) / largest(expected);
console.log(JSON.stringify({seconds: times[Math.floor(kRuns / 2)], largest_difference: difference}));
