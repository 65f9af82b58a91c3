// SPDX-License-Identifier: Apache-2.0
// node wasm_batch.mjs FOLDER MODULE: as batch.mjs, by tetralight.wasm.
import {readFileSync} from 'node:fs';
import {join} from 'node:path';

import {Batch, Tetralight} from '../../../runtime/wasm/module.mjs';

const kRuns = 5;
const [folder, module] = process.argv.slice(2);

function bytes(name) {
    const file = readFileSync(join(folder, name));
    return file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
}

function largest(values) {
    let found = 0;
    for (const value of values) found = Math.max(found, Math.abs(value));
    return found;
}

const tetralight = await Tetralight.load(readFileSync(module));
const volume = tetralight.open(bytes('volume.probes'));
const expected = new Float32Array(bytes('answers.f32'));
const batch = new Batch(tetralight, {positions: new Float32Array(bytes('positions.f32'))});
const times = [];
let sh;
for (let run = 0; run < kRuns; ++run) {
    const start = performance.now();
    ({sh} = batch.run(volume));
    times.push((performance.now() - start) / 1000);
}
times.sort((a, b) => a - b);
const difference = largest(sh.map((value, i) => value - expected[i])) / largest(expected);
console.log(JSON.stringify({seconds: times[Math.floor(kRuns / 2)], largest_difference: difference}));
