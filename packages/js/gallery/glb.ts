// SPDX-License-Identifier: Apache-2.0
// A glTF file of one mesh with a white, rough material that reflects nothing but diffuse light.

export interface Triangles {
    positions: Float32Array;
    normals: Float32Array;
    indices: Uint16Array;
}

/** A sphere of radius 1, by rows of latitude. */
export function makeSphere(rows = 48): Triangles {
    const columns = 2 * rows;
    const points: number[] = [];
    for (let row = 0; row <= rows; ++row) {
        for (let column = 0; column <= columns; ++column) {
            const [polar, turn] = [Math.PI * row / rows, 2 * Math.PI * column / columns];
            points.push(Math.sin(polar) * Math.cos(turn), Math.cos(polar), -Math.sin(polar) * Math.sin(turn));
        }
    }
    const indices: number[] = [];
    for (let row = 0; row < rows; ++row) {
        for (let column = 0; column < columns; ++column) {
            const from = row * (columns + 1) + column;
            const below = from + columns + 1;
            indices.push(from, below, below + 1, from, below + 1, from + 1);
        }
    }
    return {positions: new Float32Array(points), normals: new Float32Array(points), indices: new Uint16Array(indices)};
}

const kMaterial = {
    pbrMetallicRoughness: {baseColorFactor: [1, 1, 1, 1], metallicFactor: 0, roughnessFactor: 1},
    extensions: {KHR_materials_specular: {specularFactor: 0}},
};

export function makeGlb({positions, normals, indices}: Triangles): Uint8Array {
    const views = [positions, normals, indices].map(array => new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    let length = 0;
    const bufferViews = views.map((view, i) => {
        const byteOffset = length;
        length += Math.ceil(view.length / 4) * 4;
        return {buffer: 0, byteOffset, byteLength: view.length, target: i < 2 ? 34962 : 34963};
    });
    const bounds = [Math.min, Math.max].map(pick => [0, 1, 2].map(axis =>
        positions.filter((_, i) => i % 3 === axis).reduce((a, b) => pick(a, b))));
    const json = {
        asset: {version: '2.0'}, scene: 0, scenes: [{nodes: [0]}], // Not static: `tetralight` lights it as what moves.
        nodes: [{mesh: 0, extras: {contribute_gi: false}}],
        extensionsUsed: ['KHR_materials_specular'], materials: [kMaterial],
        meshes: [{primitives: [{attributes: {POSITION: 0, NORMAL: 1}, indices: 2, material: 0}]}],
        accessors: [
            {bufferView: 0, componentType: 5126, count: positions.length / 3, type: 'VEC3', min: bounds[0], max: bounds[1]},
            {bufferView: 1, componentType: 5126, count: normals.length / 3, type: 'VEC3'},
            {bufferView: 2, componentType: 5123, count: indices.length, type: 'SCALAR'},
        ],
        bufferViews, buffers: [{byteLength: length}],
    };
    const binary = new Uint8Array(length);
    views.forEach((view, i) => binary.set(view, bufferViews[i].byteOffset));
    return joinGlb(json, binary);
}

/** The chunks of a .glb file. */
export function joinGlb(json: object, binary: Uint8Array): Uint8Array {
    const text = new TextEncoder().encode(JSON.stringify(json));
    const textLength = Math.ceil(text.length / 4) * 4;
    const glb = new Uint8Array(12 + 8 + textLength + 8 + binary.length);
    const numbers = new DataView(glb.buffer);
    const kGltf = 0x46546c67;
    const kJson = 0x4e4f534a;
    const kBinary = 0x004e4942;
    [kGltf, 2, glb.length, textLength, kJson].forEach((value, i) => numbers.setUint32(4 * i, value, true));
    glb.fill(0x20, 20, 20 + textLength);
    glb.set(text, 20);
    numbers.setUint32(20 + textLength, binary.length, true);
    numbers.setUint32(24 + textLength, kBinary, true);
    glb.set(binary, 28 + textLength);
    return glb;
}
