// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tetralight::detail {

/// 2^64 divided by the golden ratio: the increment of SplitMix64.
inline constexpr uint64_t kGoldenRatio64 = 0x9e3779b97f4a7c15u;

/// Finalizer of SplitMix64 (Steele, Lea & Flood 2014): every input bit reaches every output bit.
[[nodiscard]] constexpr uint64_t mix(uint64_t x) noexcept {
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

}  // namespace tetralight::detail
