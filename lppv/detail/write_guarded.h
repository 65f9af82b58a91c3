// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/lppv/lppv_texture.h>

namespace tetralight::detail {

/// Writes a grid into each slab of an atlas, its minimum corner at `min`, surrounded by a copy of
/// its outer texels. `texels` has the texels of the grid, x fastest, for one slab after the other.
/// Precondition: the grid and one texel more on each side lie in the slab.
void write_guarded(LppvTexture& atlas, glm::uvec3 min, glm::uvec3 resolution,
                   std::span<const std::byte> texels) noexcept;

}  // namespace tetralight::detail
