// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace tetralight::detail {

/// What light is divided by before it is stored as half floats: 1 if these hold the largest
/// magnitude well, otherwise the power of two that brings it into [2^11, 2^12).
[[nodiscard]] inline float half_scale(float largest) noexcept {
    if (!(largest > 0.0f) || (largest >= 0x1p-4f && largest < 0x1p15f)) return 1.0f;
    constexpr int kExponent = 12, kLeast = -126;
    int exponent = 0;
    std::frexp(largest, &exponent);
    return std::ldexp(1.0f, std::max(exponent - kExponent, kLeast));
}

}  // namespace tetralight::detail
