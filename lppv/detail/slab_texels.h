// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <tetralight/lppv/lppv_texture.h>

namespace tetralight::detail {

/// The texel of one grid point in each slab.
using SlabTexels = std::array<glm::vec4, 7>;

[[nodiscard]] SlabTexels slab_texels(LppvLayout layout, const PackedSh& light,
                                     const glm::vec4& occlusion) noexcept;

/// Writes a texel, rounded to the format.
void write_texel(std::byte* to, LppvTexelFormat format, const glm::vec4& value) noexcept;

/// Packed light without its band 2.
[[nodiscard]] PackedSh without_band_2(PackedSh light) noexcept;

/// Light of four slabs, with s0 in `w` of SHA, combined with the band 2 of other light.
[[nodiscard]] PackedSh with_band_2(PackedSh light, const PackedSh& band_2) noexcept;

/// Light at coordinates in the first slab, for `sample_sh9`. Four slabs use `band_2`.
[[nodiscard]] PackedSh sample_slabs(const LppvTexture& texture, glm::vec3 uvw,
                                    const PackedSh& band_2) noexcept;

}  // namespace tetralight::detail
