// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/detail/write_guarded.h>

#include <algorithm>
#include <cstring>

#include <tetralight/base/contract.h>

namespace tetralight::detail {
namespace {

/// The coordinate of the grid point that is written at `texel` of the guarded box.
uint32_t source_of(uint32_t texel, uint32_t count) {
    return std::min(std::max(texel, 1u) - 1, count - 1);
}

template <size_t kBytes>
void write_row(std::byte* to, const std::byte* from, uint32_t count) {
    std::memcpy(to, from, kBytes);
    for (size_t x = 0; x < count; ++x) {
        std::memcpy(to + (x + 1) * kBytes, from + x * kBytes, kBytes);
    }
    std::memcpy(to + (count + 1) * kBytes, from + (count - 1) * kBytes, kBytes);
}

template <size_t kBytes>
void write_slabs(LppvTexture& atlas, glm::uvec3 min, glm::uvec3 resolution,
                 const std::byte* texels) {
    const uint32_t slabs = slab_count(atlas.layout);
    const size_t row_bytes = resolution.x * kBytes;
    const size_t slab_bytes = size_t{resolution.y} * resolution.z * row_bytes;
    const size_t slab_width = atlas.size.x / slabs;
    for (uint32_t z = 0; z < resolution.z + 2; ++z) {
        for (uint32_t y = 0; y < resolution.y + 2; ++y) {
            const size_t row = size_t{min.z - 1 + z} * atlas.size.y + min.y - 1 + y;
            const size_t source_row =
                size_t{source_of(z, resolution.z)} * resolution.y + source_of(y, resolution.y);
            std::byte* to = &atlas.texels[(row * atlas.size.x + min.x - 1) * kBytes];
            const std::byte* from = texels + source_row * row_bytes;
            for (uint32_t slab = 0; slab < slabs; ++slab) {
                write_row<kBytes>(to + slab * slab_width * kBytes, from + slab * slab_bytes,
                                  resolution.x);
            }
        }
    }
}

}  // namespace

void write_guarded(LppvTexture& atlas, glm::uvec3 min, glm::uvec3 resolution,
                   std::span<const std::byte> texels) noexcept {
    TETRALIGHT_ASSERT(min.x > 0 && min.y > 0 && min.z > 0, "the guard lies in the slab");
    if (atlas.format == LppvTexelFormat::Half) {
        write_slabs<texel_size(LppvTexelFormat::Half)>(atlas, min, resolution, texels.data());
    } else {
        write_slabs<texel_size(LppvTexelFormat::Float)>(atlas, min, resolution, texels.data());
    }
}

}  // namespace tetralight::detail
