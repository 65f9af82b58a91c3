// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bench/grid_scenes.h>
#include <tetralight/bench/harness.h>

namespace tetralight::bench {

/// Who is told to be inside of a scene's geometry, against what is, and how fast. Returns how many
/// candidates were kept inside of closed meshes.
double measure_inside(const GridSubject& subject, const Options& options);

/// Probes of a grid inside of closed meshes.
[[nodiscard]] double count_inside(const GridSubject& subject, const ProbeGrid& grid);

}  // namespace tetralight::bench
