// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace tetralight {

/// The dimension that positions span: -1 = no positions, 0 = a point, 1 = a line, 2 = a plane,
/// 3 = space. An extent below a millionth of the largest one counts as zero.
[[nodiscard]] int affine_dimension(std::span<const glm::dvec3> positions);

}  // namespace tetralight
