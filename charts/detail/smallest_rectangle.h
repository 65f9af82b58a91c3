// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace tetralight::detail {

/// Direction of a side of the rectangle of least area about some points, unit length. (1, 0) if the
/// points are all equal.
///
/// A side of that rectangle lies on the convex hull (Freeman & Shapira 1975). Of hulls with many
/// edges only the longest are tried.
[[nodiscard]] glm::dvec2 smallest_rectangle_side(std::vector<glm::dvec2> points);

}  // namespace tetralight::detail
