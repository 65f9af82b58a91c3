// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

namespace tetralight {

/// Shape of a tetrahedron: 6√2 · volume / (root mean square of its edges)³. 1 when regular, 0 when
/// flat, negative when turned inside out.
[[nodiscard]] double tetrahedron_quality(const glm::dvec3& a, const glm::dvec3& b,
                                         const glm::dvec3& c, const glm::dvec3& d);

}  // namespace tetralight
