// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace tetralight {

/// As many positions as reports show.
inline constexpr size_t kMostSpreadPositions = 8;

/// The indices of at most `most` of the positions, more than `spacing` metres apart: of the one
/// nearest to their mean first, then always of the one farthest from those before.
[[nodiscard]] std::vector<size_t> spread_positions(std::span<const glm::dvec3> positions,
                                                   double spacing,
                                                   size_t most = kMostSpreadPositions);

/// A position in metres, as reports show it.
[[nodiscard]] glm::dvec3 rounded_to_millimetre(const glm::dvec3& position);

}  // namespace tetralight
