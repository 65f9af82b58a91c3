// SPDX-License-Identifier: Apache-2.0
// Writes gltf_blobs.json: what gltf_variants.py cannot encode with Python alone. It takes the box from stdin:
//     python3 gltf_variants.py --box | node gltf_blobs.mjs > gltf_blobs.json
// and needs the npm packages draco3dgltf, meshoptimizer and sharp.
import { readFileSync } from 'node:fs';
import draco3d from 'draco3dgltf';
import { MeshoptEncoder } from 'meshoptimizer';
import sharp from 'sharp';

const box = JSON.parse(readFileSync(0));  // positions, normals, uvs, indices: flat lists; color: sRGB, 0 to 255
const base64 = bytes => Buffer.from(bytes).toString('base64');
const blobs = {};

// --- Draco ---
const draco = await draco3d.createEncoderModule({});
function dracoBlob(method, names) {
    const builder = new draco.MeshBuilder(), mesh = new draco.Mesh(), encoder = new draco.Encoder();
    const count = box.positions.length / 3;
    builder.AddFacesToMesh(mesh, box.indices.length / 3, new Uint32Array(box.indices));
    const kinds = { POSITION: [draco.POSITION, 3, box.positions], NORMAL: [draco.NORMAL, 3, box.normals],
                    TEXCOORD_0: [draco.TEX_COORD, 2, box.uvs] };
    const ids = {};
    for (const name of names) {
        const [kind, size, values] = kinds[name];
        ids[name] = builder.AddFloatAttributeToMesh(mesh, kind, count, size, new Float32Array(values));
        encoder.SetAttributeQuantization(kind, 16);
    }
    encoder.SetEncodingMethod(method);
    encoder.SetSpeedOptions(5, 5);
    const out = new draco.DracoInt8Array();
    const size = encoder.EncodeMeshToDracoBuffer(mesh, out);
    const bytes = Buffer.from(Array.from({ length: size }, (_, i) => out.GetValue(i) & 255));
    return { data: base64(bytes), attributes: ids };
}
blobs.draco_edgebreaker = dracoBlob(draco.MESH_EDGEBREAKER_ENCODING, ['POSITION', 'NORMAL', 'TEXCOORD_0']);
blobs.draco_sequential = dracoBlob(draco.MESH_SEQUENTIAL_ENCODING, ['POSITION', 'NORMAL', 'TEXCOORD_0']);

// --- Meshopt ---
await MeshoptEncoder.ready;
const bytesOf = array => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
const meshopt = (array, count, stride, mode, version) =>
    base64(MeshoptEncoder.encodeGltfBuffer(bytesOf(array), count, stride, mode, version));
const count = box.positions.length / 3;
const positions = new Float32Array(box.positions), indices = new Uint16Array(box.indices);
for (const version of [0, 1]) {
    blobs[`meshopt_positions_v${version}`] = meshopt(positions, count, 12, 'ATTRIBUTES', version);
}
blobs.meshopt_triangles = meshopt(indices, indices.length, 2, 'TRIANGLES');
blobs.meshopt_triangles_32 = meshopt(new Uint32Array(box.indices), indices.length, 4, 'TRIANGLES');
blobs.meshopt_indices = meshopt(indices, indices.length, 2, 'INDICES');
const exponential = MeshoptEncoder.encodeFilterExp(positions, count, 12, 20);
blobs.meshopt_exponential = meshopt(exponential, count, 12, 'ATTRIBUTES', 0);
const normals = new Float32Array(count * 4);
for (let i = 0; i < count; ++i) normals.set(box.normals.slice(3 * i, 3 * i + 3), 4 * i);
blobs.meshopt_octahedral = meshopt(MeshoptEncoder.encodeFilterOct(normals, count, 4, 8), count, 4, 'ATTRIBUTES', 0);

// --- Images of one color ---
const [r, g, b] = box.color;
const flat = channels => sharp({ create: { width: 8, height: 8, channels, background: { r, g, b, alpha: 0.2 } } });
const jpeg = { quality: 100, chromaSubsampling: '4:4:4' };
blobs.jpeg = base64(await flat(3).jpeg(jpeg).toBuffer());
blobs.jpeg_progressive = base64(await flat(3).jpeg({ ...jpeg, progressive: true }).toBuffer());
blobs.jpeg_420 = base64(await flat(3).jpeg({ quality: 100, chromaSubsampling: '4:2:0' }).toBuffer());
blobs.jpeg_gray = base64(await flat(3).extractChannel(0).toColourspace('b-w').jpeg({ quality: 100 }).toBuffer());
blobs.jpeg_cmyk = base64(await flat(3).toColourspace('cmyk').jpeg(jpeg).toBuffer());
blobs.webp_lossless = base64(await flat(3).webp({ lossless: true }).toBuffer());
blobs.webp_lossy = base64(await flat(3).webp({ quality: 100 }).toBuffer());
blobs.webp_alpha = base64(await flat(4).webp({ lossless: true }).toBuffer());
blobs.avif = base64(await flat(3).avif({ quality: 100 }).toBuffer());
process.stdout.write(JSON.stringify(blobs, null, 1) + '\n');
