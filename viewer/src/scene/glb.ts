// SPDX-License-Identifier: Apache-2.0
// The JSON of binary glTF files.

/** What the page reads of the JSON of a glTF file. */
export interface GltfNode {
    name?: string;
    children?: number[];
    matrix?: number[];
    translation?: number[];
    rotation?: number[];
    scale?: number[];
    extras?: Record<string, unknown>;
    [member: string]: unknown;
}

export interface Gltf {
    scene?: number;
    scenes?: {nodes?: number[]; [member: string]: unknown}[];
    nodes?: GltfNode[];
    animations?: {channels: {target: {node?: number}}[]}[];
    skins?: {joints: number[]; skeleton?: number}[];
    [member: string]: unknown;
}

const kMagic = 0x46546c67;  // "glTF"
const kJson = 0x4e4f534a;   // "JSON"
const kHeader = 12;
const kChunkHeader = 8;

function jsonLength(glb: ArrayBuffer): number {
    const view = new DataView(glb);
    const isGlb = glb.byteLength >= kHeader + kChunkHeader && view.getUint32(0, true) === kMagic &&
        view.getUint32(16, true) === kJson;
    if (!isGlb) throw new Error('the scene is not a binary glTF 2.0 file');
    return view.getUint32(kHeader, true);
}

export function readGlbJson(glb: ArrayBuffer): Gltf {
    const bytes = new Uint8Array(glb, kHeader + kChunkHeader, jsonLength(glb));
    return JSON.parse(new TextDecoder().decode(bytes)) as Gltf;
}

/** The same file with other JSON. */
export function withGlbJson(glb: ArrayBuffer, json: Gltf): ArrayBuffer {
    const rest = new Uint8Array(glb, kHeader + kChunkHeader + jsonLength(glb));
    const text = new TextEncoder().encode(JSON.stringify(json));
    const length = Math.ceil(text.length / 4) * 4;
    const made = new Uint8Array(kHeader + kChunkHeader + length + rest.length).fill(0x20);  // spaces pad JSON
    const view = new DataView(made.buffer);
    [kMagic, 2, made.length, length, kJson].forEach((word, i) => view.setUint32(4 * i, word, true));
    made.set(text, kHeader + kChunkHeader);
    made.set(rest, kHeader + kChunkHeader + length);
    return made.buffer;
}
