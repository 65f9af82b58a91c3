// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace tetralight {

/// 8-bit RGBA pixels, top row first, as files store them (colour is usually sRGB-encoded).
struct Image8 {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<std::array<uint8_t, 4>> pixels;

    bool operator==(const Image8&) const = default;
};

/// Linear Rec.709 RGB pixels, top row first.
struct ImageF {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<glm::vec3> pixels;

    bool operator==(const ImageF&) const = default;
};

}  // namespace tetralight
