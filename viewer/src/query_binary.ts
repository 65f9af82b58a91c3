// SPDX-License-Identifier: Apache-2.0
// The binary form of queries: the twin of server/query_binary.h.

const kRequest = 0x31514c54;
const kAnswer = 0x31414c54;
const kHeaderBytes = 16;
const kCellBytes = 24;
const kWantsCells = 2;

/** Which light to ask for: none (cells alone) or `PackedSh`, 28 floats. */
export enum WantedSh { None = 0, Packed = 2 }

/** Where positions lie: `CellLocation` of probes/locate.h. */
export interface Locations {
    count: number;
    cells: Uint32Array;
    ambient: Float32Array;
    weights: Float32Array;  // four each
}

export interface Answer {
    sh: Float32Array;  // 28 each, or none
    locations: Locations;
}

export function encodeQuery(positions: Float32Array, sh: WantedSh): ArrayBuffer {
    const body = new ArrayBuffer(kHeaderBytes + positions.byteLength);
    const view = new DataView(body);
    view.setUint32(0, kRequest, true);
    view.setUint32(4, positions.length / 3, true);
    view.setUint8(8, sh);
    view.setUint8(9, kWantsCells);
    new Float32Array(body, kHeaderBytes).set(positions);
    return body;
}

export function decodeAnswer(body: ArrayBuffer): Answer {
    const view = new DataView(body);
    if (body.byteLength < kHeaderBytes || view.getUint32(0, true) !== kAnswer) {
        throw new Error('the answer to a query is not one');
    }
    const count = view.getUint32(4, true);
    const shFloats = view.getUint8(8) === WantedSh.Packed ? count * 28 : 0;
    const begin = kHeaderBytes + shFloats * 4;
    if (body.byteLength !== begin + count * kCellBytes) {
        throw new Error('the answer to a query has a wrong length');
    }
    const words = new Uint32Array(body, begin);
    const floats = new Float32Array(body, begin);
    const locations: Locations = {
        count,
        cells: new Uint32Array(count),
        ambient: new Float32Array(count),
        weights: new Float32Array(count * 4),
    };
    for (let i = 0; i < count; ++i) {
        locations.cells[i] = words[6 * i];
        locations.ambient[i] = floats[6 * i + 1];
        locations.weights.set(floats.subarray(6 * i + 2, 6 * i + 6), 4 * i);
    }
    return {sh: new Float32Array(body, kHeaderBytes, shFloats), locations};
}
