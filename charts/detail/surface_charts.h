// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/charts/detail/mesh_topology.h>

namespace tetralight::detail {

/// Triangles that are projected along one direction. No two overlap in the projection.
struct SurfaceChart {
    glm::dvec3 axis{};  ///< unit length; the projection is seen from where it points
    double area = 0.0;
    std::vector<uint32_t> triangles;
};

}  // namespace tetralight::detail
