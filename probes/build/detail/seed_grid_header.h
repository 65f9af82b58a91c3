// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/base/box.h>
#include <tetralight/probes/seed_grid.h>

namespace tetralight::detail {

/// A grid of voxels of equal sides, about `voxel_count` of them, in a box and in a layer around it:
/// walks of positions outside the hull begin in that layer, at a hull cell.
[[nodiscard]] SeedGridHeader make_seed_grid_header(const Box<glm::dvec3>& box, double voxel_count);

}  // namespace tetralight::detail
