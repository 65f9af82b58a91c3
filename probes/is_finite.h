// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace tetralight {

/// True if no coordinate is NaN or infinite.
template <class T>
[[nodiscard]] bool is_finite(const glm::vec<3, T>& v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace tetralight
