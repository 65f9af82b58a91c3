// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/charts/detail/surface_charts.h>

namespace tetralight::detail {

/// Cuts a mesh into charts. Each grows from one of the largest triangles that are in none, over
/// edges, while the cosine between a triangle's normal and the axis is at least `min_cosine` and
/// nothing overlaps. The axis follows the mean normal of what it reaches. Triangles without area
/// join any chart.
[[nodiscard]] std::vector<SurfaceChart> grow_charts(const MeshTopology& mesh, double min_cosine);

}  // namespace tetralight::detail
