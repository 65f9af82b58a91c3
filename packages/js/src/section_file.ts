// SPDX-License-Identifier: Apache-2.0
// The container of `.probes` files: a header, a table of sections, and sections at multiples of 64 bytes
// (docs/file_format.md).
import {sectionError, TetralightError} from './error.js';
import {xxh3} from './xxh3.js';

const kHeaderSize = 64;
const kEntrySize = 64;
const kAlignment = 64;
const kMaxSectionCount = 1024;

/** No vertex, no neighbor, no cell. */
export const kNone = 0xffffffff;

export interface Section {
    name: string;
    offset: number;
    count: number;
    elementSize: number;
    checksum: bigint;
}

/** How files of one kind begin, and what messages call them. */
export interface FileKind {
    magic: string;
    version: number;
    name: string;
}

/** A file whose header, table, checksums and padding are right. What sections mean is not known here. */
export class SectionFile {
    readonly sections = new Map<string, Section>();
    private readonly bytes: Uint8Array;

    constructor(kind: FileKind, data: FileData) {
        this.bytes = inPlaceBytes(data);
        for (const section of readTable(kind, this.bytes)) this.sections.set(section.name, section);
        verifyBytes(this.bytes, [...this.sections.values()]);
    }

    has(name: string): boolean {
        return this.sections.has(name);
    }

    floats(name: string, each: number): Float32Array {
        return this.array(name, Float32Array, each);
    }

    doubles(name: string, each: number): Float64Array {
        return this.array(name, Float64Array, each);
    }

    /** 32-bit words. */
    words(name: string, each: number): Uint32Array {
        return this.array(name, Uint32Array, each);
    }

    halves(name: string, each: number): Uint16Array {
        return this.array(name, Uint16Array, each);
    }

    octets(name: string, each: number): Uint8Array {
        return this.array(name, Uint8Array, each);
    }

    /** Text in UTF-8. */
    text(name: string): string {
        return decodeText(name, this.octets(name, 1));
    }

    /** A section in place: `each` values an element. Empty if the file does not have it. */
    private array<T>(name: string, type: ArrayType<T>, each: number): T {
        const section = this.sections.get(name);
        if (!section) return new type(new ArrayBuffer(0), 0, 0);
        const size = each * type.BYTES_PER_ELEMENT;
        if (section.elementSize !== size) {
            throw sectionError(name, `elements have ${section.elementSize} bytes instead of ${size}`);
        }
        if (section.count >= kNone) {
            throw sectionError(name, `${section.count} elements are more than 32-bit indices can name`);
        }
        return new type(this.bytes.buffer as ArrayBuffer, this.bytes.byteOffset + section.offset, section.count * each);
    }
}

/** Bytes that must be UTF-8. */
export function decodeText(section: string, bytes: Uint8Array): string {
    try {
        return new TextDecoder('utf-8', {fatal: true, ignoreBOM: true}).decode(bytes);
    } catch {
        throw sectionError(section, 'is not UTF-8');
    }
}

interface ArrayType<T> {
    readonly BYTES_PER_ELEMENT: number;
    new(buffer: ArrayBuffer, offset: number, length: number): T;
}

/** Files, as readers take them. */
export type FileData = ArrayBuffer | ArrayBufferView | SharedArrayBuffer;

/** The bytes where they are; a copy if others could change their number or content meanwhile, or if not aligned. */
export function inPlaceBytes(data: FileData): Uint8Array {
    if (new Uint8Array(new Uint32Array([1]).buffer)[0] !== 1) {
        throw new TetralightError('unsupported', '', 'files are little-endian, and this machine is not');
    }
    if (!ArrayBuffer.isView(data) && !isBuffer(data)) {
        throw new TetralightError('invalid_argument', 'data', 'data is neither an ArrayBuffer nor a view of one');
    }
    const bytes = ArrayBuffer.isView(data) ? new Uint8Array(data.buffer, data.byteOffset, data.byteLength)
                                           : new Uint8Array(data);
    const buffer = bytes.buffer as ArrayBuffer & {resizable?: boolean};
    const isFixed = Object.prototype.toString.call(buffer) === '[object ArrayBuffer]' && buffer.resizable !== true;
    return isFixed && bytes.byteOffset % 8 === 0 ? bytes : new Uint8Array(bytes);
}

/** Buffers of other realms (frames, workers, test runners) count, which `instanceof` would not find. */
function isBuffer(data: unknown): data is ArrayBuffer {
    return /^\[object (Shared)?ArrayBuffer\]$/.test(Object.prototype.toString.call(data));
}

const corrupt = (what: string) => new TetralightError('corrupt', '', what);

function readTable(kind: FileKind, bytes: Uint8Array): Section[] {
    if (bytes.length < kHeaderSize) throw corrupt(`not a ${kind.name} (shorter than a header)`);
    const header = new DataView(bytes.buffer, bytes.byteOffset, kHeaderSize);
    if (String.fromCharCode(...bytes.subarray(0, 8)) !== kind.magic) {
        throw corrupt(`not a ${kind.name} (wrong first bytes)`);
    }
    const version = header.getUint32(8, true);
    if (version !== kind.version) {
        throw new TetralightError('unsupported', 'version',
                                  `file version ${version} is not supported (this program reads ${kind.version})`);
    }
    const size = readSize(header, 16);
    if (size !== bytes.length) throw corrupt(`the file has ${bytes.length} bytes, but its header says ${size}`);
    const count = header.getUint32(12, true);
    if (count > kMaxSectionCount || count * kEntrySize > bytes.length - kHeaderSize) {
        throw corrupt(`section count ${count} is out of range`);
    }
    if (header.getBigUint64(24, true) !== headerChecksum(bytes, count)) {
        throw corrupt('the header or the section table is corrupt (wrong checksum)');
    }
    return readEntries(bytes, count);
}

/** xxh3 of the table, seeded by that of the header without its checksum. */
function headerChecksum(bytes: Uint8Array, count: number): bigint {
    const header = bytes.slice(0, kHeaderSize);
    header.fill(0, 24, 32);
    return xxh3(bytes.subarray(kHeaderSize, kHeaderSize + count * kEntrySize), xxh3(header));
}

/** A size of 64 bits. Those above 2^53 lose digits, but not that they are too large. */
export function readSize(view: DataView, at: number): number {
    return view.getUint32(at, true) + view.getUint32(at + 4, true) * 0x100000000;
}

function readEntries(bytes: Uint8Array, count: number): Section[] {
    const table = new DataView(bytes.buffer, bytes.byteOffset + kHeaderSize, count * kEntrySize);
    const names = new Set<string>();
    const sections: Section[] = [];
    let end = kHeaderSize + count * kEntrySize;
    for (let i = 0; i < count; ++i) {
        const at = i * kEntrySize;
        const start = kHeaderSize + at;
        const section = {
            name: String.fromCharCode(...bytes.subarray(start, start + 24)).split('\0', 1)[0],
            offset: readSize(table, at + 24),
            count: readSize(table, at + 32),
            elementSize: readSize(table, at + 40),
            checksum: table.getBigUint64(at + 48, true),
        };
        if (names.has(section.name)) throw sectionError(section.name, 'occurs twice');
        checkEntry(section, end, bytes.length);
        names.add(section.name);
        sections.push(section);
        end = section.offset + section.count * section.elementSize;
    }
    return sections;
}

function checkEntry({name, offset, count, elementSize}: Section, end: number, fileSize: number): void {
    if (offset % kAlignment !== 0 || offset < end) throw sectionError(name, `offset ${offset} is out of place`);
    const room = fileSize - Math.min(offset, fileSize);
    if (elementSize === 0 || count > Math.floor(room / elementSize)) {
        throw sectionError(name, `${count} elements of ${elementSize} bytes at ${offset} do not fit in the file of ` +
                                 `${fileSize} bytes`);
    }
}

function verifyBytes(bytes: Uint8Array, sections: readonly Section[]): void {
    let end = kHeaderSize + sections.length * kEntrySize;
    for (const {name, offset, count, elementSize, checksum} of sections) {
        if (!isZero(bytes, end, offset)) throw sectionError(name, 'bytes before it are not zero');
        end = offset + count * elementSize;
        if (xxh3(bytes.subarray(offset, end)) !== checksum) throw sectionError(name, 'is corrupt (wrong checksum)');
    }
    if (!isZero(bytes, end, bytes.length)) throw corrupt('bytes after the last section are not zero');
}

function isZero(bytes: Uint8Array, begin: number, end: number): boolean {
    for (let i = begin; i < end; ++i) {
        if (bytes[i] !== 0) return false;
    }
    return true;
}
