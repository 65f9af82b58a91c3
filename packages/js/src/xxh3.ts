// SPDX-License-Identifier: Apache-2.0
// XXH3, 64 bits: the checksum of the files, written from the specification of Collet
// (https://github.com/Cyan4973/xxHash/blob/dev/doc/xxhash_spec.md). Short inputs are hashed in BigInt; long ones in
// halves of 32 bits, which are many times faster.

const kPrime32 = [0x9e3779b1, 0x85ebca77, 0xc2b2ae3d];
const kPrime64 = [0x9e3779b185ebca87n, 0xc2b2ae3d27d4eb4fn, 0x165667b19e3779f9n, 0x85ebca77c2b2ae63n, 0x27d4eb2f165667c5n];
const kPrimeMix1 = 0x165667919e3779f9n;
const kPrimeMix2 = 0x9fb21c651e98df25n;

const kSecretSize = 192;
const kSecretText =
    'b8fe6c3923a44bbe7c01812cf721ad1cded46de9839097db7240a4a4b7b3671fcb79e64eccc0e578825ad07dccff7221' +
    'b8084674f743248ee03590e6813a264c3c2852bb91c300cb88d0658b1b532ea371644897a20df94e3819ef46a9deacd8' +
    'a8fa763fe39c343ff9dcbbc7c70b4f1d8a51e04bcdb45931c89f7ec9d9787364eac5ac8334d3ebc3c581a0fffa1363eb' +
    '170ddd51b7f0da49d316552629d4689e2b16be587d47a1fc8ff8b8d17ad031ce45cb3a8f95160428afd7fbcabb4b407e';

const kStripe = 64;
const kStripesInBlock = (kSecretSize - kStripe) / 8;

const wrap = (x: bigint) => BigInt.asUintN(64, x);
const rotate = (x: bigint, bits: bigint) => wrap(x << bits) | x >> (64n - bits);

/** The low half of the product of two 64-bit numbers, xor the high half. */
function fold(a: bigint, b: bigint): bigint {
    const product = a * b;
    return wrap(product) ^ product >> 64n;
}

function avalanche(x: bigint): bigint {
    x = wrap((x ^ x >> 37n) * kPrimeMix1);
    return x ^ x >> 32n;
}

/** That of the older XXH64, for the shortest inputs. */
function oldAvalanche(x: bigint): bigint {
    x = wrap((x ^ x >> 33n) * kPrime64[1]);
    x = wrap((x ^ x >> 29n) * kPrime64[2]);
    return x ^ x >> 32n;
}

function reversedBytes(x: bigint, count: number): bigint {
    let reversed = 0n;
    for (let i = 0; i < count; ++i) {
        reversed = reversed << 8n | x & 0xffn;
        x >>= 8n;
    }
    return reversed;
}

function parseSecret(): DataView {
    const bytes = new Uint8Array(kSecretSize);
    for (let i = 0; i < kSecretSize; ++i) bytes[i] = parseInt(kSecretText.slice(2 * i, 2 * i + 2), 16);
    return new DataView(bytes.buffer);
}

/** The xxh3 of some bytes as a number of 64 bits. */
export function xxh3(bytes: Uint8Array, seed = 0n): bigint {
    const input = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const secret = parseSecret();
    if (bytes.length <= 16) return hashUpTo16(input, secret, seed);
    if (bytes.length <= 240) return hashUpTo240(input, secret, seed);
    return hashLong(bytes, seed === 0n ? secret : seededSecret(secret, seed));
}

function hashUpTo16(input: DataView, secret: DataView, seed: bigint): bigint {
    const key = (at: number) => secret.getBigUint64(at, true);
    const length = input.byteLength;
    if (length === 0) return oldAvalanche(seed ^ key(56) ^ key(64));
    if (length <= 3) {
        const [first, middle, last] = [0, length >> 1, length - 1].map(at => BigInt(input.getUint8(at)));
        const combined = first << 16n | middle << 24n | last | BigInt(length) << 8n;
        const flip = wrap(BigInt(secret.getUint32(0, true) ^ secret.getUint32(4, true)) & 0xffffffffn) + seed;
        return oldAvalanche(wrap(combined ^ wrap(flip)));
    }
    if (length <= 8) {
        const turned = seed ^ reversedBytes(seed & 0xffffffffn, 4) << 32n;
        const low = BigInt(input.getUint32(length - 4, true));
        const value = low | BigInt(input.getUint32(0, true)) << 32n;
        return mixShort(value ^ wrap((key(8) ^ key(16)) - turned), BigInt(length));
    }
    const low = input.getBigUint64(0, true) ^ wrap((key(24) ^ key(32)) + seed);
    const high = input.getBigUint64(length - 8, true) ^ wrap((key(40) ^ key(48)) - seed);
    return avalanche(wrap(BigInt(length) + reversedBytes(low, 8) + high + fold(low, high)));
}

function mixShort(x: bigint, length: bigint): bigint {
    x = wrap((x ^ rotate(x, 49n) ^ rotate(x, 24n)) * kPrimeMix2);
    x = wrap((x ^ (x >> 35n) + length) * kPrimeMix2);
    return x ^ x >> 28n;
}

function hashUpTo240(input: DataView, secret: DataView, seed: bigint): bigint {
    const length = input.byteLength;
    const mix = (at: number, key: number) =>
        fold(input.getBigUint64(at, true) ^ wrap(secret.getBigUint64(key, true) + seed),
             input.getBigUint64(at + 8, true) ^ wrap(secret.getBigUint64(key + 8, true) - seed));
    let sum = BigInt(length) * kPrime64[0];
    if (length <= 128) {
        const pairs = (length - 1) >> 5;
        for (let i = 0; i <= pairs; ++i) sum += mix(16 * i, 32 * i) + mix(length - 16 * (i + 1), 32 * i + 16);
        return avalanche(wrap(sum));
    }
    for (let i = 0; i < 8; ++i) sum += mix(16 * i, 16 * i);
    sum = avalanche(wrap(sum));
    for (let i = 8; i < length >> 4; ++i) sum += mix(16 * i, 16 * (i - 8) + 3);
    return avalanche(wrap(sum + mix(length - 16, 136 - 17)));
}

function seededSecret(secret: DataView, seed: bigint): DataView {
    const seeded = new DataView(new ArrayBuffer(kSecretSize));
    for (let at = 0; at < kSecretSize; at += 16) {
        seeded.setBigUint64(at, wrap(secret.getBigUint64(at, true) + seed), true);
        seeded.setBigUint64(at + 8, wrap(secret.getBigUint64(at + 8, true) - seed), true);
    }
    return seeded;
}

/** Eight sums of 64 bits as pairs (low, high) of doubles: 16 stripes do not fill their 53 bits. */
function firstSums(): Float64Array {
    const sums = [BigInt(kPrime32[2]), kPrime64[0], kPrime64[1], kPrime64[2], kPrime64[3], BigInt(kPrime32[1]), kPrime64[4],
                  BigInt(kPrime32[0])];
    return Float64Array.from(sums.flatMap(sum => [Number(sum & 0xffffffffn), Number(sum >> 32n)]));
}

function hashLong(bytes: Uint8Array, secret: DataView): bigint {
    const length = bytes.length;
    const wholeWords = length >> 2;
    const aligned = bytes.byteOffset % 4 === 0 ? bytes : bytes.slice();
    const words = new Uint32Array(aligned.buffer, aligned.byteOffset, wholeWords);
    const keys = new Uint32Array(secret.buffer);
    const sums = firstSums();
    const stripes = Math.floor((length - 1) / kStripe);
    for (let stripe = 0; stripe < stripes; stripe += kStripesInBlock) {
        const count = Math.min(kStripesInBlock, stripes - stripe);
        for (let i = 0; i < count; ++i) addStripe(sums, words, 16 * (stripe + i), keys, 2 * i);
        settle(sums);
        if (count === kStripesInBlock) scramble(sums, keys, (kSecretSize - kStripe) / 4);
    }
    const last = new Uint32Array(bytes.slice(length - kStripe).buffer);
    const lastKeys = new Uint32Array(secret.buffer.slice(kSecretSize - kStripe - 7, kSecretSize - 7));
    addStripe(sums, last, 0, lastKeys, 0);
    settle(sums);
    return merge(sums, secret, length);
}

function addStripe(sums: Float64Array, words: Uint32Array, at: number, keys: Uint32Array, key: number): void {
    for (let i = 0; i < 16; i += 2) {
        const low = words[at + i];
        const high = words[at + i + 1];
        const a = (low ^ keys[key + i]) >>> 0;
        const b = (high ^ keys[key + i + 1]) >>> 0;
        const productLow = Math.imul(a, b) >>> 0;
        // a · b in double is wrong by less than 2^11: rounding finds the high half.
        sums[i] += productLow;
        sums[i + 1] += Math.round((a * b - productLow) / 0x100000000);
        sums[i ^ 2] += low;
        sums[(i ^ 2) + 1] += high;
    }
}

/** Carries from low halves to high ones. */
function settle(sums: Float64Array): void {
    for (let i = 0; i < 16; i += 2) {
        const low = sums[i];
        sums[i + 1] = (sums[i + 1] + Math.floor(low / 0x100000000)) % 0x100000000;
        sums[i] = low % 0x100000000;
    }
}

/** x ← ((x ^ x >> 47) ^ key) · prime. */
function scramble(sums: Float64Array, keys: Uint32Array, key: number): void {
    const prime = kPrime32[0];
    for (let i = 0; i < 16; i += 2) {
        const high = sums[i + 1] >>> 0;
        const low = (sums[i] ^ high >>> 15 ^ keys[key + i]) >>> 0;
        const mixedHigh = (high ^ keys[key + i + 1]) >>> 0;
        const productLow = Math.imul(low, prime) >>> 0;
        const carried = Math.round((low * prime - productLow) / 0x100000000);
        sums[i] = productLow;
        sums[i + 1] = (carried + (Math.imul(mixedHigh, prime) >>> 0)) % 0x100000000;
    }
}

function merge(sums: Float64Array, secret: DataView, length: number): bigint {
    const sum = (i: number) => BigInt(sums[2 * i]) | BigInt(sums[2 * i + 1]) << 32n;
    let result = wrap(BigInt(length) * kPrime64[0]);
    for (let i = 0; i < 4; ++i) {
        const key = 11 + 16 * i;
        result += fold(sum(2 * i) ^ secret.getBigUint64(key, true), sum(2 * i + 1) ^ secret.getBigUint64(key + 8, true));
    }
    return avalanche(wrap(result));
}
