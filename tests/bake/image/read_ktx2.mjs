// SPDX-License-Identifier: Apache-2.0
// Reads a KTX 2.0 file by ktx-parse and checks what the test wrote: MODULES FILE TEXELS BYTES_PER_TEXEL.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { pathToFileURL } from 'node:url';

const [modules, file, texels, bytes] = process.argv.slice(2);
const { read, KHR_DF_MODEL_RGBSDA, KHR_DF_TRANSFER_LINEAR } = await import(
    pathToFileURL(`${modules}/ktx-parse/dist/index.mjs`));
const texture = read(new Uint8Array(fs.readFileSync(file)));
const size = Number(bytes);
assert.equal(texture.vkFormat, size === 8 ? 97 : 109);
assert.equal(texture.typeSize, size / 4);
assert.deepEqual([texture.pixelWidth, texture.pixelHeight, texture.pixelDepth], [5, 3, 2]);
assert.deepEqual([texture.layerCount, texture.faceCount, texture.levelCount ?? 1], [0, 1, 1]);
assert.equal(texture.supercompressionScheme, 0);
assert.equal(texture.levels.length, 1);
assert.deepEqual(Buffer.from(texture.levels[0].levelData), fs.readFileSync(texels));

const [descriptor] = texture.dataFormatDescriptor;
assert.equal(descriptor.colorModel, KHR_DF_MODEL_RGBSDA);
assert.equal(descriptor.transferFunction, KHR_DF_TRANSFER_LINEAR);
assert.equal(descriptor.bytesPlane[0], size);
assert.deepEqual(descriptor.samples.map((sample) => sample.bitOffset), [0, 1, 2, 3].map((i) => i * size * 2));
assert.deepEqual(descriptor.samples.map((sample) => sample.bitLength), Array(4).fill(size * 2 - 1));
assert.equal(texture.keyValue.KTXorientation, 'ruo');
assert.equal(new TextDecoder().decode(texture.keyValue.tetralight), '{"layout":"four slabs"}\0');
