// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <tetralight/base/half.h>
#include <tetralight/lightmap/lightmaps.h>

// The halves of texels as floats, and back. The first three values of each texel are never
// negative: irradiance, or the flux of `light`.

namespace tetralight::detail {

template <size_t count>
using TexelValues = std::array<float, count>;

template <size_t count>
[[nodiscard]] TexelValues<count> scaled_values(const std::array<uint16_t, count>& halves,
                                               float scale) noexcept {
    TexelValues<count> values;
    for (size_t i = 0; i < count; ++i) values[i] = float_from_half(halves[i]) * scale;
    return values;
}

[[nodiscard]] inline TexelValues<3> values_of(const IrradianceTexel& texel, float scale) noexcept {
    return scaled_values(texel.rgb, scale);
}

[[nodiscard]] inline TexelValues<3> values_of(const LayerTexel& texel, float scale) noexcept {
    return scaled_values(texel.rgb, scale);
}

[[nodiscard]] inline TexelValues<12> values_of(const LightmapTexel& texel, float scale) noexcept {
    return scaled_values(std::bit_cast<std::array<uint16_t, 12>>(texel), scale);
}

/// Each value rounded to the nearest half, at most 65504 · scale; the first three at least 0.
/// Precondition: the scale is a power of two.
template <size_t count>
[[nodiscard]] std::array<uint16_t, count> scaled_halves(const TexelValues<count>& values,
                                                        float scale) noexcept {
    const float inverse = 1.0f / scale;
    std::array<uint16_t, count> halves;
    for (size_t i = 0; i < count; ++i) {
        const float value = values[i] * inverse;
        halves[i] = half_from_float_saturated(i < 3 ? std::max(0.0f, value) : value);
    }
    return halves;
}

/// Keeps the coverage of the texel.
inline void store_values(const TexelValues<3>& values, float scale,
                         IrradianceTexel& texel) noexcept {
    texel.rgb = scaled_halves(values, scale);
}

inline void store_values(const TexelValues<12>& values, float scale,
                         LightmapTexel& texel) noexcept {
    texel = std::bit_cast<LightmapTexel>(scaled_halves(values, scale));
}

}  // namespace tetralight::detail
