// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include <tetralight/probes/sh.h>

namespace tetralight {

/// One of the layers that a volume's light is the weighted sum of: that of the sun, the sky, a lamp
/// or a material, by `layer_names`. "rest" is what no other layer has.
struct Layer {
    /// What the resident light holds of it; 1 = as it was baked.
    float weight = 1.0f;
    /// The largest |coefficient| of its irradiance at any probe.
    float largest = 0.0f;
    /// Its share of the volume's ambient light.
    IrradianceSh ambient;
    std::array<uint32_t, 3> reserved{};

    bool operator==(const Layer&) const = default;
};

static_assert(sizeof(Layer) == 128 && std::is_trivially_copyable_v<Layer>);

}  // namespace tetralight
