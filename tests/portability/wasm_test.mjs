// SPDX-License-Identifier: Apache-2.0
// node wasm_test.mjs MODULE VECTORS_FOLDER NAME...: holds tetralight.wasm against the conformance vectors, as
// check_answers.cpp does. Prints one line; exit code 1 if anything is wrong.
import {readFileSync} from 'node:fs';
import {join} from 'node:path';

import {Batch, Tetralight} from '../../runtime/wasm/module.mjs';

// What docs/how_to_query.md allows readers to differ by.
const kLightTolerance = 1e-5;
const kOcclusionTolerance = 2e-5;
const kAnswerWords = 3 + 3 + 27 + 4;

const [modulePath, folder, ...names] = process.argv.slice(2);

function bytes(path) {
    const file = readFileSync(path);
    return file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
}

/** Reads the words that write_cases.py writes. */
class Words {
    constructor(buffer) {
        this.words = new Uint32Array(buffer);
        this.floats = new Float32Array(buffer);
        this.place = 0;
    }

    next() {
        return this.words[this.place++];
    }

    nextFloat() {
        return this.floats[this.place++];
    }

    nextFloats(count) {
        this.place += count;
        return this.floats.slice(this.place - count, this.place);
    }
}

/** One member of all answers, which have `count` floats from float `begin` on. */
function member(answers, begin, count) {
    const total = answers.length / kAnswerWords;
    const values = new Float32Array(total * count);
    for (let i = 0; i < total; ++i) {
        const from = i * kAnswerWords + begin;
        values.set(answers.subarray(from, from + count), i * count);
    }
    return values;
}

function readCase(words) {
    const largestLight = words.nextFloat();
    const options = {
        outside: words.next(),
        fadeDistance: words.nextFloat(),
        walls: words.next(),
    };
    const layers = words.next(), radius = words.nextFloat(), normalOffset = words.nextFloat();
    const weights = words.nextFloats(words.next());
    const count = words.next();
    const answers = words.nextFloats(count * kAnswerWords);
    options.positions = member(answers, 0, 3);
    options.renderingLayers = new Uint32Array(count).fill(layers);
    options.radii = new Float32Array(count).fill(radius);
    if (normalOffset >= 0) Object.assign(options, {normals: member(answers, 3, 3), normalOffset});
    return {largestLight, options, weights, sh: member(answers, 6, 27), occlusion: member(answers, 33, 4)};
}

/** The largest difference over the tolerance; NaN counts as infinite. */
function difference(ours, expected, tolerance) {
    let largest = 0;
    for (let i = 0; i < expected.length; ++i) {
        const apart = Math.abs(ours[i] - expected[i]) / tolerance;
        largest = apart <= largest ? largest : Number.isNaN(apart) ? Infinity : apart;
    }
    return largest;
}

function checkCase(tetralight, file, expected) {
    const volume = tetralight.open(file);
    if (expected.weights.length > 0) tetralight.recombine(volume, expected.weights);
    const batch = new Batch(tetralight, expected.options);
    const {sh, occlusion} = batch.run(volume);
    const worst = Math.max(difference(sh, expected.sh, kLightTolerance * expected.largestLight),
                           difference(occlusion, expected.occlusion, kOcclusionTolerance));
    batch.free();
    tetralight.close(volume);
    return worst;
}

/** Corrupt bytes are an error with a message, and the module goes on. */
function refusesDamage(tetralight, file) {
    const damaged = new Uint8Array(file.slice(0));
    damaged[damaged.length - 1] ^= 1;
    try {
        tetralight.open(damaged.buffer);
    } catch (error) {
        return error.message.startsWith('memory: ');
    }
    return false;
}

/** Calls that fail free what was copied in for them. */
function freesAfterFailures(tetralight, file) {
    let allocated = 0;
    const {malloc, free} = tetralight.exports;
    const counted = new Tetralight({
        ...tetralight.exports,
        malloc: (size) => (allocated += 1, malloc(size)),
        free: (address) => (allocated -= address === 0 ? 0 : 1, free(address)),
    });
    const before = allocated;
    const volume = counted.open(file);
    for (const call of [() => counted.recombine(volume, [-1]), () => counted.open(new ArrayBuffer(64))]) {
        try {
            call();
            return false;
        } catch {
            // That was expected.
        }
    }
    counted.close(volume);
    return allocated === before;
}

/** Addresses from 2 GiB up, which a module returns as negative numbers, are positive. */
function hasUnsignedAddresses() {
    return new Tetralight({malloc: () => -16}).allocate(1) === 2 ** 32 - 16;
}

const moduleBytes = readFileSync(modulePath);
const imports = WebAssembly.Module.imports(new WebAssembly.Module(moduleBytes));
const wrong = imports.map(({module, name}) => `the module imports ${module}.${name}`);
let answers = 0;
if (wrong.length === 0) {
    const tetralight = await Tetralight.load(moduleBytes);
    for (const name of names) {
        const file = bytes(join(folder, `${name}.probes`));
        const words = new Words(bytes(join(folder, `${name}.cases`)));
        const count = words.next();
        for (let i = 0; i < count; ++i) {
            const expected = readCase(words);
            const worst = checkCase(tetralight, file, expected);
            answers += expected.occlusion.length / 4;
            if (worst > 1) wrong.push(`${name}: case ${i} differs by ${worst} times the tolerance`);
        }
        if (words.place !== words.words.length) wrong.push(`${name}: the file of cases is damaged`);
        if (!refusesDamage(tetralight, file)) wrong.push(`${name}: a damaged file is not refused`);
        if (!freesAfterFailures(tetralight, file)) wrong.push(`${name}: memory is lost by a call that fails`);
    }
    if (!hasUnsignedAddresses()) wrong.push('addresses from 2 GiB up are negative');
}
for (const line of wrong) console.error(line);
const kilobytes = Math.round(moduleBytes.length / 1000);
console.log(wrong.length > 0 ? `${wrong.length} checks failed`
                             : `no imports, ${kilobytes} kB, ${answers} answers of ${names.length} volumes from memory: right`);
process.exit(wrong.length > 0 || answers === 0 ? 1 : 0);
