// SPDX-License-Identifier: Apache-2.0
// Arrays of cubes of RGBA halves in KTX 2.0 files (Khronos, "KTX File Format Specification", version 2.0).
import {TetralightError} from './error.js';
import {FileData, inPlaceBytes, readSize} from './section_file.js';

const kIdentifier = [0xab, 0x4b, 0x54, 0x58, 0x20, 0x32, 0x30, 0xbb, 0x0d, 0x0a, 0x1a, 0x0a];
const kHeaderSize = 80;
const kLevelSize = 24;
const kRgbaHalves = 97;  // VK_FORMAT_R16G16B16A16_SFLOAT
const kTexelSize = 8;
const kFaces = 6;
const kLargestSize = 4096;
const kMostCubes = 65536;

export interface Ktx2Cubes {
    /** Texels along a side of a face of level 0. */
    size: number;
    cubeCount: number;
    /** The halves of each level, the largest level first. */
    levels: Uint16Array[];
    /** Key/value data: the bytes of each value. */
    values: Map<string, Uint8Array>;
}

const corrupt = (field: string, what: string) => new TetralightError('corrupt', field, what);
const unsupported = (field: string, what: string) => new TetralightError('unsupported', field, what);

export function readKtx2Cubes(data: FileData): Ktx2Cubes {
    const bytes = inPlaceBytes(data);
    if (!kIdentifier.every((byte, i) => bytes[i] === byte)) throw corrupt('', 'not a KTX 2.0 file (wrong first bytes)');
    if (bytes.length < kHeaderSize) throw corrupt('', 'the file ends within its header');
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    checkKind(view);
    checkDescriptor(view);
    const [size, cubeCount, levelCount] = [20, 32, 40].map(at => view.getUint32(at, true));
    const levels = Array.from({length: levelCount}, (_, i) => readLevel(view, i, cubeCount * kFaces * (size >> i) ** 2));
    return {size, cubeCount, levels, values: readValues(view)};
}

function checkKind(view: DataView): void {
    const [format, typeSize, width, height, depth, cubeCount, faceCount, levelCount, compression] =
        [12, 16, 20, 24, 28, 32, 36, 40, 44].map(at => view.getUint32(at, true));
    if (compression !== 0) throw unsupported('supercompression', 'the texture is compressed');
    if (format !== kRgbaHalves) {
        throw unsupported('vk_format', `the texture has Vulkan's format ${format} instead of RGBA halves (97)`);
    }
    if (faceCount !== kFaces || depth !== 0 || cubeCount === 0) {
        throw unsupported('face_count', 'the texture is not an array of cubes');
    }
    if (typeSize !== 2) throw corrupt('type_size', `halves of ${typeSize} bytes`);
    const isPower = width > 0 && (width & width - 1) === 0;
    if (width !== height || width > kLargestSize || !isPower) {
        throw corrupt('size', `faces of ${width} x ${height} texels: not a power of two of at most ${kLargestSize}`);
    }
    if (cubeCount > kMostCubes) throw corrupt('layer_count', `${cubeCount} cubes are more than ${kMostCubes}`);
    if (levelCount === 0 || levelCount > Math.log2(width) + 1) {
        throw corrupt('level_count', `${levelCount} levels do not fit faces of ${width} texels`);
    }
}

const fits = (view: DataView, offset: number, size: number) => offset <= view.byteLength && size <= view.byteLength - offset;

function checkDescriptor(view: DataView): void {
    const [offset, size] = [48, 52].map(at => view.getUint32(at, true));
    if (!fits(view, offset, size) || size < 4) {
        throw corrupt('descriptor', 'the data format descriptor lies outside the file');
    }
    if (view.getUint32(offset, true) !== size) {
        throw corrupt('descriptor', 'the data format descriptor has another size than it states');
    }
}

function readLevel(view: DataView, level: number, texels: number): Uint16Array {
    const field = `levels[${level}]`;
    const at = kHeaderSize + level * kLevelSize;
    if (!fits(view, at, kLevelSize)) throw corrupt('levels', 'the file ends within its index of levels');
    const [offset, size, uncompressed] = [0, 8, 16].map(member => readSize(view, at + member));
    const expected = texels * kTexelSize;
    if (size !== expected || uncompressed !== expected) {
        throw corrupt(field, `level ${level} has ${size} bytes, ${uncompressed} uncompressed, instead of ${expected}`);
    }
    if (!fits(view, offset, size) || offset % kTexelSize !== 0) {
        throw corrupt(field, `level ${level} lies outside the file or between texels`);
    }
    return new Uint16Array(view.buffer as ArrayBuffer, view.byteOffset + offset, size / 2);
}

function readValues(view: DataView): Map<string, Uint8Array> {
    const [begin, size] = [56, 60].map(at => view.getUint32(at, true));
    if (!fits(view, begin, size)) throw corrupt('metadata', 'the key/value data lies outside the file');
    const values = new Map<string, Uint8Array>();
    const end = begin + size;
    for (let at = begin; at < end;) {
        const length = end - at >= 4 ? view.getUint32(at, true) : Infinity;
        if (length > end - at - 4) throw corrupt('metadata', 'a pair of the key/value data does not fit');
        const pair = new Uint8Array(view.buffer, view.byteOffset + at + 4, length);
        const zero = pair.indexOf(0);
        if (zero < 0) throw corrupt('metadata', 'a pair of the key/value data does not fit');
        const key = String.fromCharCode(...pair.subarray(0, Math.min(zero, 64)));
        if (values.has(key)) throw corrupt(key, `key "${key}" occurs twice`);
        values.set(key, pair.subarray(zero + 1));
        at += 4 + Math.ceil(length / 4) * 4;
    }
    return values;
}
