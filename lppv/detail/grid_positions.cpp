// SPDX-License-Identifier: Apache-2.0
#include "lppv/detail/grid_positions.h"

#include <algorithm>

#include "base/assert.h"

namespace tetralight::detail {

void grid_positions(const LppvGrid& grid, size_t begin, std::span<glm::vec3> positions) noexcept {
    TETRALIGHT_ASSERT(begin % grid.resolution.x == 0, "rows are filled from their first point");
    TETRALIGHT_ASSERT(begin + positions.size() <= grid.point_count(), "points of the grid");
    const glm::dvec3 step(grid.world_from_local[0] * grid.step.x);
    size_t row = begin / grid.resolution.x;
    for (size_t i = 0; i < positions.size(); ++row) {
        const glm::uvec3 first(0, row % grid.resolution.y, row / grid.resolution.y);
        const glm::dvec3 origin = grid.world_position(first);
        const size_t end = std::min(i + grid.resolution.x, positions.size());
        for (double x = 0.0; i < end; x += 1.0) positions[i++] = glm::vec3(origin + x * step);
    }
}

}  // namespace tetralight::detail
