// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace tetralight::detail {

/// The point of a triangle, even one without area, that is nearest to `position`.
[[nodiscard]] glm::vec3 closest_point(glm::vec3 position, const std::array<glm::vec3, 3>& triangle);

}  // namespace tetralight::detail
