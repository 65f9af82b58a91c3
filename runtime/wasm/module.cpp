// SPDX-License-Identifier: Apache-2.0
// What makes tetralight.wasm a module without imports: the functions of WASI that the standard
// libraries call. There is nothing to write a last message to, and no clock.
#include <cstddef>
#include <cstdint>

#include <tetralight/runtime/tetralight.h>

namespace {

constexpr uint16_t kBadDescriptor = 8;  // WASI's number

}  // namespace

extern "C" {

uint16_t __wasi_clock_time_get(uint32_t, uint64_t, uint64_t* nanoseconds) {
    *nanoseconds = 0;
    return 0;
}

uint16_t __wasi_fd_close(int) {
    return kBadDescriptor;
}

uint16_t __wasi_fd_seek(int, int64_t, uint8_t, uint64_t*) {
    return kBadDescriptor;
}

uint16_t __wasi_fd_write(int, const void*, size_t, size_t*) {
    return kBadDescriptor;
}
}

// module.mjs writes these structs.
static_assert(sizeof(tetralight_const_array) == 12 && sizeof(tetralight_array) == 12);
static_assert(offsetof(tetralight_batch, positions) == 4 && offsetof(tetralight_batch, sh) == 28 &&
              offsetof(tetralight_batch, sh_format) == 40 &&
              offsetof(tetralight_batch, occlusion) == 44 &&
              offsetof(tetralight_batch, outside) == 56 &&
              offsetof(tetralight_batch, rendering_layers) == 68 &&
              offsetof(tetralight_batch, radii) == 80 &&
              offsetof(tetralight_batch, normals) == 92 &&
              offsetof(tetralight_batch, normal_offset) == 104 && sizeof(tetralight_batch) == 108);
static_assert(sizeof(tetralight_error) == 512);
