// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <tetralight/probes/sh.h>

namespace tetralight {

/// One of the layers whose weighted sum is the light of a volume: the light of the sun, the sky, a
/// lamp or a material, by `layer_names`. "rest" is the light that is in no other layer.
struct Layer {
    /// Its factor in the volume's light; 1 = as it was baked.
    float weight = 1.0f;
    /// The largest |coefficient| of its irradiance at any probe.
    float largest = 0.0f;
    /// The ambient light of this layer at weight 1.
    IrradianceSh ambient;
    std::array<uint32_t, 3> reserved{};

    bool operator==(const Layer&) const = default;
};

static_assert(sizeof(Layer) == 128 && std::is_trivially_copyable_v<Layer>);

/// Elements of a section that has one for each probe, or texel, in each layer. 64 bits: size_t may
/// not hold the product of two counts of a corrupt file.
[[nodiscard]] constexpr uint64_t layer_element_count(size_t layer_count,
                                                     size_t element_count) noexcept {
    return uint64_t{layer_count} * element_count;
}

}  // namespace tetralight
