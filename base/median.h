// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace tetralight {

/// The middle one of three numbers.
[[nodiscard]] constexpr double median(double a, double b, double c) noexcept {
    return std::max(std::min(a, b), std::min(c, std::max(a, b)));
}

}  // namespace tetralight
