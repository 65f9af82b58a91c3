// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace tetralight {

/// What positions span: -1 = there are none, 0 = a point, 1 = a line, 2 = a plane, 3 = space. What
/// is flatter than a millionth of their extent counts as flat.
[[nodiscard]] int affine_dimension(std::span<const glm::dvec3> positions);

}  // namespace tetralight
