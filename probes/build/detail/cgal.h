// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/probes/probe_volume.h>

// The uses of CGAL other than tetrahedra (probes/build/detail/delaunay.h).

namespace tetralight::detail {

/// Delaunay triangles over distinct positions that are not all on one line, counter-clockwise, with
/// three vertices, in no particular order.
[[nodiscard]] std::vector<Cell> delaunay_triangles(std::span<const glm::dvec2> positions);

/// Exact sign of dot(b − a, cross(c − a, d − a)).
[[nodiscard]] int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                              const glm::dvec3& d);

/// Exact: true if `position` lies strictly inside the circumsphere of a positively oriented
/// tetrahedron.
[[nodiscard]] bool is_in_circumsphere(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                      const glm::dvec3& d, const glm::dvec3& position);

/// The same in a plane: exact sign of cross(b − a, c − a), and true if `position` lies strictly
/// inside the circle through a counter-clockwise triangle.
[[nodiscard]] int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);
[[nodiscard]] bool is_in_circumcircle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                                      const glm::dvec2& position);

}  // namespace tetralight::detail
