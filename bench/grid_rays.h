// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bench/grid_scenes.h>

namespace tetralight::bench {

/// Reports the rays that placed an adaptive grid, over those of a bake of its probes by default
/// settings (`grid.rays`). `asked`: the number of probes that were asked for.
void report_rays(const GridSubject& subject, const ProbeGrid& grid, uint64_t asked);

}  // namespace tetralight::bench
