// SPDX-License-Identifier: Apache-2.0
// KTX 2.0 files without compression, with JSON under the key "tetralight": proxy volumes as `tetralight lppv`
// writes them, and reflection probes.
import * as three from 'three';

import {emptyConstants, LppvConstants} from './shaders';

export const kHalf = 97;   // VK_FORMAT_R16G16B16A16_SFLOAT
const kFloat = 109;        // VK_FORMAT_R32G32B32A32_SFLOAT

export interface Ktx2 {
    format: number;
    width: number;
    height: number;
    depth: number;
    layerCount: number;  // 0: not an array
    faceCount: number;
    levels: ArrayBuffer[];  // the largest first
    keys: Map<string, string>;
}

/** `what` names the file in errors. */
export function readKtx2(file: ArrayBuffer, what: string): Ktx2 {
    const view = new DataView(file);
    if (file.byteLength < 104 || view.getUint32(0, true) !== 0x58544bab) {
        throw new Error(`${what} is not a KTX 2.0 file`);
    }
    const [format, , width, height, depth, layerCount, faceCount, levelCount] =
        [12, 16, 20, 24, 28, 32, 36, 40].map(at => view.getUint32(at, true));
    const levels = Array.from({length: Math.max(1, levelCount)}, (_, level) => {
        const [begin, length] = [80, 88].map(at => Number(view.getBigUint64(at + 24 * level, true)));
        if (begin + length > file.byteLength) throw new Error(`${what} ends within level ${level}`);
        return file.slice(begin, begin + length);
    });
    return {format, width, height, depth, layerCount, faceCount, levels, keys: keysOf(file, view)};
}

export interface LppvTexture {
    texture: three.Data3DTexture;
    constants: LppvConstants;
}

export function parseLppv(file: ArrayBuffer): LppvTexture {
    const {format, width, height, depth, levels: [texels], keys} = readKtx2(file, 'the proxy volume');
    if (format !== kHalf && format !== kFloat) {
        throw new Error(`the proxy volume has texels of format ${format}`);
    }
    const texture = new three.Data3DTexture(
        format === kHalf ? new Uint16Array(texels) : new Float32Array(texels), width, height, depth);
    texture.format = three.RGBAFormat;
    texture.type = format === kHalf ? three.HalfFloatType : three.FloatType;
    texture.minFilter = texture.magFilter = three.LinearFilter;
    texture.needsUpdate = true;
    const words = keys.get('tetralight');
    if (words === undefined) throw new Error('the proxy volume has no constants');
    return {texture, constants: constantsOf(JSON.parse(words) as Record<string, number[]>)};
}

function keysOf(file: ArrayBuffer, view: DataView): Map<string, string> {
    const found = new Map<string, string>();
    const begin = view.getUint32(56, true);
    const end = begin + view.getUint32(60, true);
    for (let at = begin; at + 4 <= end;) {
        const length = view.getUint32(at, true);
        const text = new TextDecoder().decode(new Uint8Array(file, at + 4, length));
        const [key, value] = text.split('\0');
        found.set(key, value);
        at += 4 + Math.ceil(length / 4) * 4;
    }
    return found;
}

function constantsOf(json: Record<string, number[]>): LppvConstants {
    const constants = emptyConstants();
    constants.local_from_world.fromArray(json.local_from_world);
    for (const name of ['params', 'low', 'size_inverse', 'shb_r', 'shb_g', 'shb_b', 'shc'] as const) {
        constants[name].fromArray(json[name]);
    }
    return constants;
}
