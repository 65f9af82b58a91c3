// SPDX-License-Identifier: Apache-2.0
// Reads a file of reflection probes by ktx-parse and checks what the test wrote: MODULES FILE LEVEL_0 LEVEL_1.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { pathToFileURL } from 'node:url';

const [modules, file, ...levels] = process.argv.slice(2);
const { read, KHR_DF_TRANSFER_LINEAR } = await import(pathToFileURL(`${modules}/ktx-parse/dist/index.mjs`));
const texture = read(new Uint8Array(fs.readFileSync(file)));
assert.equal(texture.vkFormat, 97);
assert.deepEqual([texture.pixelWidth, texture.pixelHeight, texture.pixelDepth], [4, 4, 0]);
assert.deepEqual([texture.layerCount, texture.faceCount], [2, 6]);
assert.equal(texture.levels.length, levels.length);
levels.forEach((level, i) => assert.deepEqual(Buffer.from(texture.levels[i].levelData), fs.readFileSync(level)));
assert.equal(texture.dataFormatDescriptor[0].transferFunction, KHR_DF_TRANSFER_LINEAR);
assert.equal(texture.keyValue.KTXorientation, 'rd');
const json = new TextDecoder().decode(texture.keyValue.tetralight).replace(/\0$/, '');
assert.deepEqual(JSON.parse(json).probes.map((probe) => probe.name), ['hall "A"', 'sky\\dome é']);
