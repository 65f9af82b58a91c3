// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace tetralight::detail {

/// Density per steradian of uniform directions.
inline constexpr float kSpherePdf = 0.25f * std::numbers::inv_pi_v<float>;

/// Power heuristic with β = 2 for two sampling techniques (Veach & Guibas 1995). `pdf` may be
/// infinite, and the squares of the densities may overflow: only their ratio is squared.
[[nodiscard]] inline float power_heuristic(float pdf, float other_pdf) noexcept {
    if (std::isinf(pdf)) return 1.0f;
    const float ratio = other_pdf / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

/// The same for three: one against the two others.
[[nodiscard]] inline float power_heuristic(float pdf, float second, float third) noexcept {
    return power_heuristic(pdf, std::hypot(second, third));
}

}  // namespace tetralight::detail
