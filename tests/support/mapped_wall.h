// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "tests/support/scenes.h"

// Surfaces with normal maps.

namespace tetralight::test {

/// A texel of a normal map from x and y of its normal.
inline std::array<uint8_t, 4> normal_texel(float x, float y) {
    const auto code = [](float value) {
        return static_cast<uint8_t>(std::lround(127.5f * (value + 1.0f)));
    };
    return {code(x), code(y), 255, 255};
}

/// Adds a normal map of one texel to the scene and gives it to a material.
inline void set_normal_map(Scene& scene, Material& material, glm::vec2 xy) {
    material.normal_texture.texture = static_cast<uint32_t>(scene.normal_maps.size());
    scene.normal_maps.push_back({"map", Image8{1, 1, {normal_texel(xy.x, xy.y)}}});
}

/// The normal that `set_normal_map` stores, rounded as the texel.
inline glm::vec3 stored_normal(glm::vec2 xy) {
    const auto texel = normal_texel(xy.x, xy.y);
    const glm::vec2 rounded(2.0f * static_cast<float>(texel[0]) / 255.0f - 1.0f,
                            2.0f * static_cast<float>(texel[1]) / 255.0f - 1.0f);
    return {rounded, std::sqrt(1.0f - rounded.x * rounded.x - rounded.y * rounded.y)};
}

}  // namespace tetralight::test
