// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

#include <tetralight/probes/sh.h>

namespace tetralight {

/// True if no coordinate is NaN or infinite.
template <class T>
[[nodiscard]] bool is_finite(const glm::vec<3, T>& v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

[[nodiscard]] inline bool is_finite(const IrradianceSh& sh) noexcept {
    return std::ranges::all_of(sh.coefficients, [](const glm::vec3& c) { return is_finite(c); });
}

}  // namespace tetralight
