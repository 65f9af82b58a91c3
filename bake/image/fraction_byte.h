// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tetralight {

/// A fraction as 8 bits hold it: clamped to [0, 1], times 255, rounded.
[[nodiscard]] inline uint8_t fraction_byte(float fraction) noexcept {
    return static_cast<uint8_t>(std::lround(255.0f * std::clamp(fraction, 0.0f, 1.0f)));
}

}  // namespace tetralight
