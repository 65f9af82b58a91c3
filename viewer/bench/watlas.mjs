// SPDX-License-Identifier: Apache-2.0
// Unwraps meshes with watlas, which is xatlas as WebAssembly, as the baseline of `lightmap.charts` and
// `lightmap.unwrap`: node watlas.mjs TEXELS_PER_METER RUNS < MESHES.
// Reads for each mesh two uint32, the numbers of vertices and indices, then three float32 a vertex and the
// indices as uint32. Writes {"charts": of all, "cpu_seconds": median of the runs}. Exit code 77: no watlas.
import {readFileSync} from 'node:fs';

const watlas = await import('watlas').catch(() => process.exit(77));
const [texelsPerUnit, runs] = process.argv.slice(2).map(Number);

function readMeshes() {
    const bytes = readFileSync(0);
    const {buffer} = Uint8Array.from(bytes);
    const meshes = [];
    for (let at = 0; at < buffer.byteLength;) {
        const [vertexCount, indexCount] = new Uint32Array(buffer, at, 2);
        const vertexPositionData = new Float32Array(buffer, at + 8, 3 * vertexCount);
        const indexData = new Uint32Array(buffer, at + 8 + vertexPositionData.byteLength, indexCount);
        meshes.push({vertexPositionData, vertexCount, vertexPositionStride: 12, indexData, indexCount});
        at += 8 + vertexPositionData.byteLength + indexData.byteLength;
    }
    return meshes;
}

/** Each mesh for itself, with the two free texels between charts that ours have. */
function unwrap(meshes) {
    let charts = 0;
    for (const mesh of meshes) {
        const atlas = new watlas.Atlas();
        atlas.addMesh(mesh);
        atlas.generate({}, {texelsPerUnit, padding: 2, bilinear: true});
        charts += atlas.chartCount;
        atlas.delete();
    }
    return charts;
}

await watlas.Initialize();
const meshes = readMeshes();
const seconds = [];
let charts = 0;
for (let run = 0; run < runs; ++run) {
    const before = process.cpuUsage();
    charts = unwrap(meshes);
    const {user, system} = process.cpuUsage(before);
    seconds.push((user + system) / 1e6);
}
seconds.sort((a, b) => a - b);
console.log(JSON.stringify({charts, cpu_seconds: seconds[runs >> 1]}));
