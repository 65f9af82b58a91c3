// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// Bilinear lookup of a colour texture: RGB decoded from sRGB before filtering, alpha linear.
[[nodiscard]] glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv);

/// The alpha of `sample_texture` alone, with the same bits.
[[nodiscard]] float sample_texture_alpha(const Texture& texture, glm::vec2 uv);

/// Bilinear lookup of a data texture: all four channels linear, 0 to 1.
[[nodiscard]] glm::vec4 sample_data_texture(const Texture& texture, glm::vec2 uv);

}  // namespace tetralight
