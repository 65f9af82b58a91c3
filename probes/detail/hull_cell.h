// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// A surface that the cells' rays reach later than this, in units of the longest
/// difference, belongs to another cell.
inline constexpr double kFarthestRoot = 0x1p20;

/// Rounding of the square of an area whose edges have length 1.
inline constexpr double kFlatTriangle = 1e-24;

/// A hull triangle and a query, in differences of positions: no digit is lost far away.
struct HullTriangle {
    glm::dvec3 first{0.0};     ///< from the third corner to the first
    glm::dvec3 second{0.0};    ///< from the third corner to the second
    glm::dvec3 to_query{0.0};  ///< from the third corner to the query
};

[[nodiscard]] inline HullTriangle make_hull_triangle(const std::array<glm::dvec3, 3>& corners,
                                                     const glm::dvec3& query) noexcept {
    return {corners[0] - corners[2], corners[1] - corners[2], query - corners[2]};
}

/// Barycentric weights of the query in a hull cell, i.e. of the one triangle (p_i + t v_i), t ≥ 0,
/// whose plane holds the query first (Cupisz, GDC 2012). They sum to 1; a negative one says
/// that the query lies beyond that edge's wall. None if the query is behind the hull triangle, or
/// no such plane exists.
///
/// Free of absolute thresholds: lengths are scaled by the longest of the three.
[[nodiscard]] std::optional<glm::dvec3> hull_cell_weights(const HullTriangle& triangle,
                                                          const HullCellRays& rays) noexcept;

/// The same for an edge of the hull of a plane with the given unit normal: weights of the first two
/// corners, seen along the normal. `corners` are relative to the query.
[[nodiscard]] std::optional<glm::dvec2> hull_edge_weights(const std::array<glm::dvec3, 2>& corners,
                                                          const HullCellRays& rays,
                                                          const glm::dvec3& axis) noexcept;

}  // namespace tetralight::detail
