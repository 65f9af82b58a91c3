// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/lppv/lppv_texture.h>

namespace tetralight::detail {

/// Writes a grid into each slab of an atlas, its lower corner at `low`, with a copy of its outer
/// texels all around. `texels`: those of the grid, x fastest, for one slab after the other.
/// Precondition: the grid with one texel more on each side lies in the slab.
void write_guarded(LppvTexture& atlas, glm::uvec3 low, glm::uvec3 resolution,
                   std::span<const std::byte> texels) noexcept;

}  // namespace tetralight::detail
