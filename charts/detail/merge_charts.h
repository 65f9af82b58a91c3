// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/charts/detail/surface_charts.h>

namespace tetralight::detail {

/// Merges charts that have an edge in common, the smallest first, where one direction is within the
/// cone of all normals and nothing overlaps.
[[nodiscard]] std::vector<SurfaceChart> merge_charts(const MeshTopology& mesh,
                                                     std::vector<SurfaceChart> charts,
                                                     double min_cosine);

}  // namespace tetralight::detail
