// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace tetralight {

namespace detail {

/// The nearest half-precision float, no larger in magnitude than `largest`. Without branches on
/// data, so that loops over it vectorize: Giesen 2012, "Half to float done quic(k)".
[[nodiscard]] inline uint16_t rounded_half(float value, uint32_t largest) noexcept {
    constexpr uint32_t kInfinity = 0x7f800000u, kSmallestNormal = 0x38800000u;
    constexpr uint32_t kNanHalf = 0x7e00u;
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const uint32_t magnitude = bits & 0x7fffffffu;
    // Adding 0.5 shifts the digits of a denormal half to the end of the mantissa, and rounds them.
    const uint32_t denormal =
        std::bit_cast<uint32_t>(std::bit_cast<float>(magnitude) + 0.5f) - 0x3f000000u;
    // The exponent gets its new bias; half of the last digit that stays is added to round.
    const uint32_t normal = (magnitude - 0x37fff001u + ((magnitude >> 13) & 1u)) >> 13;
    const uint32_t finite = magnitude < kSmallestNormal ? denormal : std::min(normal, largest);
    const uint32_t half = magnitude > kInfinity ? kNanHalf : finite;
    return static_cast<uint16_t>((bits >> 16 & 0x8000u) | half);
}

}  // namespace detail

/// The value of a finite half-precision float (IEEE 754), exactly. Halves that are infinite or NaN
/// become finite numbers of magnitude 65536 to 131008, so that sums over the bytes of a corrupt
/// file stay finite. Without branches and denormal floats, so that loops over it vectorize and have
/// the same speed for all values: Giesen 2012, "Half to float done quic(k)".
[[nodiscard]] inline float float_from_half(uint16_t half) noexcept {
    constexpr uint32_t kBiasDifference = 112u << 23, kSmallestNormal = 1u << 23;
    const uint32_t magnitude = (half & 0x7fffu) << 13;
    const uint32_t normal = magnitude + kBiasDifference;
    // With the exponent of 2^-14 the mantissa of a denormal half counts from there.
    const float shifted = std::bit_cast<float>(normal + kSmallestNormal);
    const uint32_t denormal = std::bit_cast<uint32_t>(shifted - 0x1p-14f);
    const uint32_t finite = magnitude < kSmallestNormal ? denormal : normal;
    return std::bit_cast<float>((half & 0x8000u) << 16 | finite);
}

/// The nearest half-precision float (IEEE 754, ties to even), as processors convert: infinite from
/// 65520 on. NaN stays NaN.
[[nodiscard]] inline uint16_t half_from_float(float value) noexcept {
    return detail::rounded_half(value, 0x7c00u);
}

/// The same, but values beyond the largest finite half become that one: ±65504.
[[nodiscard]] inline uint16_t half_from_float_saturated(float value) noexcept {
    return detail::rounded_half(value, 0x7bffu);
}

}  // namespace tetralight
