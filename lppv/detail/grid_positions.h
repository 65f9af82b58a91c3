// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/lppv/lppv_grid.h>

namespace tetralight::detail {

/// World positions of grid points for queries: `LppvGrid::world_position` with a third of its
/// arithmetic.
class GridPositions {
  public:
    explicit GridPositions(const LppvGrid& grid)
        : origin_(grid.world_position({0, 0, 0})),
          x_(grid.world_from_local[0] * grid.step.x),
          y_(grid.world_from_local[1] * grid.step.y),
          z_(grid.world_from_local[2] * grid.step.z) {}

    [[nodiscard]] glm::vec3 operator()(const glm::uvec3& point) const {
        const glm::dvec3 p(point);
        return glm::vec3(origin_ + p.x * x_ + p.y * y_ + p.z * z_);
    }

  private:
    glm::dvec3 origin_, x_, y_, z_;
};

}  // namespace tetralight::detail
