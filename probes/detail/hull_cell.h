// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// A surface that the cells' rays reach later than this, in units of the distance to the farthest
/// corner, belongs to another cell.
inline constexpr double kFarthestRoot = 0x1p20;

/// Rounding of the square of an area whose edges have length 1.
inline constexpr double kFlatTriangle = 1e-24;

/// Barycentric weights of the origin in a hull cell, i.e. of the one triangle (p_i + t v_i), t ≥ 0,
/// whose plane holds the origin first (Cupisz, GDC 2012). They sum to 1; a negative one says
/// that the origin lies beyond that edge's wall. None if the origin is behind the hull triangle, or
/// no such plane exists.
///
/// `corners` are relative to the queried position. Free of absolute thresholds: lengths are
/// scaled by the farthest corner.
[[nodiscard]] std::optional<glm::dvec3> hull_cell_weights(const std::array<glm::dvec3, 3>& corners,
                                                          const HullCellRays& rays) noexcept;

/// The same for an edge of the hull of a plane with the given unit normal: weights of the first two
/// corners, seen along the normal.
[[nodiscard]] std::optional<glm::dvec2> hull_edge_weights(const std::array<glm::dvec3, 2>& corners,
                                                          const HullCellRays& rays,
                                                          const glm::dvec3& axis) noexcept;

}  // namespace tetralight::detail
