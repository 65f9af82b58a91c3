// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "lppv/lppv_grid.h"

namespace tetralight::detail {

/// World positions of the grid points [begin, begin + positions.size()), as queries take them.
/// Precondition: `begin` is the first point of a row, and the grid has that many points.
void grid_positions(const LppvGrid& grid, size_t begin, std::span<glm::vec3> positions) noexcept;

}  // namespace tetralight::detail
