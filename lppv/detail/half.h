// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace tetralight::detail {

/// The nearest half float (IEEE 754, ties to even); what is too large becomes the largest finite
/// one, 65504. NaN stays NaN. Without branches on data, so that it can be vectorized: Giesen 2012,
/// "Half to float done quic(k)".
[[nodiscard]] inline uint16_t half_from_float(float value) noexcept {
    constexpr uint32_t kInfinity = 0x7f800000u, kSmallestNormal = 0x38800000u;
    constexpr uint32_t kLargestHalf = 0x7bffu, kNanHalf = 0x7e00u;
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const uint32_t magnitude = bits & 0x7fffffffu;
    // Adding 0.5 shifts the digits of a denormal half to the end of the mantissa, and rounds them.
    const uint32_t denormal =
        std::bit_cast<uint32_t>(std::bit_cast<float>(magnitude) + 0.5f) - 0x3f000000u;
    // A new bias of the exponent, and half of the last digit that stays.
    const uint32_t normal = (magnitude - 0x37fff001u + ((magnitude >> 13) & 1u)) >> 13;
    const uint32_t finite = magnitude < kSmallestNormal ? denormal : std::min(normal, kLargestHalf);
    const uint32_t half = magnitude > kInfinity ? kNanHalf : finite;
    return static_cast<uint16_t>((bits >> 16 & 0x8000u) | half);
}

}  // namespace tetralight::detail
