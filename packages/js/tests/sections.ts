// SPDX-License-Identifier: Apache-2.0
// Sections of files, to damage them.
import {TetralightError} from '../src/index.js';
import {xxh3} from '../src/xxh3.js';

/** What a call throws; undefined if it throws nothing. Other errors than ours are mistakes, and thrown on. */
export function errorOf(call: () => void): TetralightError | undefined {
    try {
        call();
    } catch (error) {
        if (error instanceof TetralightError) return error;
        throw error;
    }
    return undefined;
}

export interface Entry {
    name: string;
    at: number;  // of the entry
    offset: number;
    size: number;
}

export function sectionsOf(bytes: Uint8Array): Entry[] {
    const view = new DataView(bytes.buffer, bytes.byteOffset);
    return Array.from({length: view.getUint32(12, true)}, (_, i) => {
        const at = 64 + 64 * i;
        const name = new TextDecoder().decode(bytes.subarray(at, at + 24)).replace(/\0+$/, '');
        const size = Number(view.getBigUint64(at + 32, true) * view.getBigUint64(at + 40, true));
        return {name, at, offset: Number(view.getBigUint64(at + 24, true)), size};
    });
}

/** Makes checksums right again after bytes of a section changed. */
export function sign(bytes: Uint8Array, {at, offset, size}: Entry): void {
    const view = new DataView(bytes.buffer, bytes.byteOffset);
    view.setBigUint64(at + 48, xxh3(bytes.subarray(offset, offset + size)), true);
    view.setBigUint64(24, 0n, true);
    const end = 64 + 64 * view.getUint32(12, true);
    view.setBigUint64(24, xxh3(bytes.subarray(64, end), xxh3(bytes.subarray(0, 64))), true);
}
