// SPDX-License-Identifier: Apache-2.0
// Reads a 3D texture by ktx-parse and checks what the test expects: MODULES FILE TEXELS WIDTH HEIGHT DEPTH.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { pathToFileURL } from 'node:url';

const [modules, file, texels, ...size] = process.argv.slice(2);
const { read, VK_FORMAT_R16G16B16A16_SFLOAT, KHR_DF_TRANSFER_LINEAR } = await import(
    pathToFileURL(`${modules}/ktx-parse/dist/index.mjs`));
const texture = read(new Uint8Array(fs.readFileSync(file)));
assert.equal(texture.vkFormat, VK_FORMAT_R16G16B16A16_SFLOAT);
assert.deepEqual([texture.pixelWidth, texture.pixelHeight, texture.pixelDepth], size.map(Number));
assert.deepEqual([texture.layerCount, texture.faceCount, texture.levels.length], [0, 1, 1]);
assert.equal(texture.supercompressionScheme, 0);
assert.equal(texture.dataFormatDescriptor[0].transferFunction, KHR_DF_TRANSFER_LINEAR);
assert.deepEqual(Buffer.from(texture.levels[0].levelData), fs.readFileSync(texels));
