// SPDX-License-Identifier: Apache-2.0

/** A .glb file: a square floor of 4 × 4 m around the origin with this albedo. `shine`: metallicFactor, roughnessFactor. */
export function floorGlb(albedo: number, shine: Record<string, number> = {metallicFactor: 0}): Uint8Array<ArrayBuffer> {
    const positions = new Float32Array([-2, 0, -2, -2, 0, 2, 2, 0, 2, 2, 0, -2]);
    const normals = new Float32Array([0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0]);
    const indices = new Uint16Array([0, 1, 2, 0, 2, 3]);
    const arrays = [positions, normals, indices];
    const offsets = [0, 48, 96];
    const bin = new Uint8Array(108);
    arrays.forEach((array, i) => bin.set(new Uint8Array(array.buffer), offsets[i]));
    const json = {
        asset: {version: '2.0'}, scene: 0, scenes: [{nodes: [0]}], nodes: [{mesh: 0, name: 'floor'}],
        meshes: [{primitives: [{attributes: {POSITION: 0, NORMAL: 1}, indices: 2, material: 0}]}],
        materials: [{pbrMetallicRoughness: {baseColorFactor: [albedo, albedo, albedo, 1], ...shine}}],
        accessors: [
            {bufferView: 0, componentType: 5126, count: 4, type: 'VEC3', min: [-2, 0, -2], max: [2, 0, 2]},
            {bufferView: 1, componentType: 5126, count: 4, type: 'VEC3'},
            {bufferView: 2, componentType: 5123, count: 6, type: 'SCALAR'}],
        bufferViews: arrays.map((array, i) => ({buffer: 0, byteOffset: offsets[i], byteLength: array.byteLength})),
        buffers: [{byteLength: bin.length}],
    };
    const text = new TextEncoder().encode(JSON.stringify(json));
    const padded = Math.ceil(text.length / 4) * 4;
    const file = new Uint8Array(12 + 8 + padded + 8 + bin.length).fill(0x20);
    const view = new DataView(file.buffer);
    [0x46546c67, 2, file.length, padded, 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
    file.set(text, 20);
    view.setUint32(20 + padded, bin.length, true);
    view.setUint32(24 + padded, 0x004e4942, true);
    file.set(bin, 28 + padded);
    return file;
}
