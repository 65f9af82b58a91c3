// SPDX-License-Identifier: Apache-2.0
// The C API of tetralight.wasm for JavaScript: what its tests and its benchmark need, and an example of how to call it.
// Numbers are the places of members in the structs of runtime/tetralight.h, which module.cpp asserts.

const kBatchSize = 108;
const kErrorSize = 512;

/** An instance of the module. Its memory is its own: what is passed is copied in. */
export class Tetralight {
    /** `bytes`: tetralight.wasm. */
    static async load(bytes) {
        const module = await WebAssembly.compile(bytes);
        const instance = await WebAssembly.instantiate(module, {});
        instance.exports._initialize();
        return new Tetralight(instance.exports);
    }

    constructor(exports) {
        this.exports = exports;
        this.error = this.allocate(kErrorSize);
    }

    allocate(size) {
        // JavaScript receives addresses as signed numbers.
        const address = this.exports.malloc(Math.max(size, 1)) >>> 0;
        if (address === 0) throw new Error(`no memory for ${size} bytes`);
        return address;
    }

    /** A view of the module's memory. Calls that allocate may end its validity. */
    view(Type, address, count) {
        return new Type(this.exports.memory.buffer, address, count);
    }

    /** Copies an array in. */
    copy(values) {
        const address = this.allocate(values.byteLength);
        this.view(values.constructor, address, values.length).set(values);
        return address;
    }

    message() {
        const bytes = this.view(Uint8Array, this.error, kErrorSize);
        return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
    }

    check(status) {
        if (status !== 0) throw new Error(this.message());
    }

    /** Opens the bytes of a probe volume. Returns its handle. */
    open(bytes) {
        const out = this.allocate(4);
        let file = 0;
        try {
            file = this.copy(new Uint8Array(bytes));
            this.check(this.exports.tetralight_open_memory(file, bytes.byteLength, out, this.error));
            return this.view(Uint32Array, out, 1)[0];
        } finally {
            this.exports.free(file);
            this.exports.free(out);
        }
    }

    close(volume) {
        this.exports.tetralight_close(volume);
    }

    recombine(volume, weights) {
        const copy = this.copy(new Float32Array(weights));
        try {
            this.check(this.exports.tetralight_recombine(volume, copy, weights.length, this.error));
        } finally {
            this.exports.free(copy);
        }
    }
}

/** Many positions in one call. */
export class Batch {
    /**
     * `options`: positions (Float32Array), and as in the struct tetralight_batch: outside, fadeDistance, walls, radii,
     * renderingLayers, normals, normalOffset. Numbers default to 0, arrays to none.
     */
    constructor(tetralight, options) {
        this.tetralight = tetralight;
        this.count = options.positions.length / 3;
        this.sh = tetralight.allocate(this.count * 27 * 4);
        this.occlusion = tetralight.allocate(this.count * 4 * 4);
        this.owned = [this.sh, this.occlusion];
        const inputs = ['positions', 'renderingLayers', 'radii', 'normals'].map((name) => this.input(options[name]));
        this.batch = tetralight.allocate(kBatchSize);
        this.owned.push(this.batch);
        this.fill(options, inputs);
    }

    /** Address and size of a copy; zeros for no array. */
    input(values) {
        if (values === undefined) return [0, 0];
        const address = this.tetralight.copy(values);
        this.owned.push(address);
        return [address, values.byteLength];
    }

    fill(options, [positions, renderingLayers, radii, normals]) {
        this.tetralight.view(Uint8Array, this.batch, kBatchSize).fill(0);
        const words = this.tetralight.view(Uint32Array, this.batch, kBatchSize / 4);
        const floats = this.tetralight.view(Float32Array, this.batch, kBatchSize / 4);
        words[0] = this.count;
        words.set(positions, 4 / 4);
        words.set([this.sh, this.count * 27 * 4], 28 / 4);
        words.set([this.occlusion, this.count * 4 * 4], 44 / 4);
        words[56 / 4] = options.outside ?? 0;
        floats[60 / 4] = options.fadeDistance ?? 0;
        words[64 / 4] = options.walls ?? 0;
        words.set(renderingLayers, 68 / 4);
        words.set(radii, 80 / 4);
        words.set(normals, 92 / 4);
        floats[104 / 4] = options.normalOffset ?? 0;
    }

    /** Answers all positions. Returns views of the module's memory: coefficients and occlusion. */
    run(volume) {
        const {tetralight} = this;
        tetralight.check(tetralight.exports.tetralight_query_batch(volume, this.batch, 0, tetralight.error));
        return {
            sh: tetralight.view(Float32Array, this.sh, this.count * 27),
            occlusion: tetralight.view(Float32Array, this.occlusion, this.count * 4),
        };
    }

    free() {
        for (const address of this.owned) this.tetralight.exports.free(address);
    }
}
