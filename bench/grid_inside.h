// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bench/grid_scenes.h>
#include <tetralight/bench/harness.h>

namespace tetralight::bench {

/// Compares which candidates the generator classifies as inside geometry with the winding number,
/// and measures its speed. Returns the number of candidates that were kept inside closed meshes.
double measure_inside(const GridSubject& subject, const Options& options);

/// Number of probes of a grid that are inside closed meshes.
[[nodiscard]] double count_inside(const GridSubject& subject, const ProbeGrid& grid);

}  // namespace tetralight::bench
