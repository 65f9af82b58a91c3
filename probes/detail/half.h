// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

namespace tetralight::detail {

/// Half precision of a finite float, rounded to nearest, ties to even, as processors do; infinite
/// from 65520 on.
[[nodiscard]] inline uint16_t half_from_float(float value) noexcept {
    const auto bits = std::bit_cast<uint32_t>(value);
    const uint32_t sign = bits >> 16 & 0x8000u;
    const uint32_t magnitude = bits & 0x7fffffffu;
    uint32_t half = 0;
    if (magnitude >= 0x47800000u) {  // 2^16
        half = 0x7c00u;
    } else if (magnitude < 0x38800000u) {
        // Below 2^-14 halves have steps of 2^-24, those of floats between 0.5 and 1.
        half = std::bit_cast<uint32_t>(std::bit_cast<float>(magnitude) + 0.5f) - 0x3f000000u;
    } else {
        const uint32_t rounded = magnitude + 0xfffu + (magnitude >> 13 & 1u);
        half = (rounded - 0x38000000u) >> 13;
    }
    return static_cast<uint16_t>(sign | half);
}

}  // namespace tetralight::detail
