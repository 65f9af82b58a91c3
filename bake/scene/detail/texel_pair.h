// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <tetralight/bake/scene/scene.h>

namespace tetralight::detail {

/// The two texels beside a coordinate and the weight of the second one.
struct TexelPair {
    uint32_t first = 0;
    uint32_t second = 0;
    float second_weight = 0.0f;
};

/// Rounds down. std::floor is a function call on processors without SSE 4.1, and this is not.
[[nodiscard]] inline float rounded_down(float value) {
    constexpr float kAllIntegers = 0x1p23f;  // floats beyond have no fraction
    if (!(std::abs(value) < kAllIntegers)) return value;
    const auto truncated = static_cast<float>(static_cast<int32_t>(value));
    return truncated > value ? truncated - 1.0f : truncated;
}

/// The coordinate in one period, so that a large one neither overflows nor loses its fraction.
[[nodiscard]] inline float reduced(float coordinate, TextureWrap wrap) {
    if (!std::isfinite(coordinate)) return 0.0f;
    switch (wrap) {
        case TextureWrap::Repeat:
            return coordinate - rounded_down(coordinate);
        case TextureWrap::MirroredRepeat:
            return coordinate - 2.0f * rounded_down(coordinate * 0.5f);
        case TextureWrap::ClampToEdge:
            break;
    }
    return std::clamp(coordinate, 0.0f, 1.0f);
}

/// Texel index of an index up to one period outside of the image.
[[nodiscard]] inline uint32_t wrapped(int64_t index, int64_t size, TextureWrap wrap) {
    if (wrap == TextureWrap::ClampToEdge) {
        return static_cast<uint32_t>(std::clamp<int64_t>(index, 0, size - 1));
    }
    const int64_t period = wrap == TextureWrap::Repeat ? size : 2 * size;
    const int64_t inside = index < 0 ? index + period : (index < period ? index : index - period);
    return static_cast<uint32_t>(inside < size ? inside : period - 1 - inside);
}

/// The texels between whose centers a coordinate lies, for linear filtering.
[[nodiscard]] inline TexelPair texels_at(float coordinate, uint32_t size, TextureWrap wrap) {
    const float texel = reduced(coordinate, wrap) * static_cast<float>(size) - 0.5f;
    const float floor = rounded_down(texel);
    const auto first = static_cast<int64_t>(floor);
    return {wrapped(first, size, wrap), wrapped(first + 1, size, wrap), texel - floor};
}

}  // namespace tetralight::detail
