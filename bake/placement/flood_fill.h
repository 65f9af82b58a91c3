// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/free_space_map.h>
#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// The result of the flood fill.
struct FloodFill {
    /// The space of each kept probe.
    std::vector<uint32_t> spaces;
    std::vector<DroppedSpace> dropped_spaces;
    /// The spaces to fill, sorted. If unreachable spaces are kept, only those that have probes.
    std::vector<uint32_t> wanted;
    /// All spaces that have probes, kept or dropped, sorted.
    std::vector<uint32_t> filled;
};

/// Drops the probes outside of the spaces to fill: those of the seeds (`settings.from`), else the
/// space with most probes, unless unreachable spaces are kept. Joins the spaces in the map that a
/// probe or a seed sees. Returns invalid_argument, with the field `from`, if a seed is inside
/// geometry, outside of the bounds, or in a gap without a point of the map.
[[nodiscard]] Result<FloodFill> drop_unreachable(const TraceScene& traced, FreeSpaceMap& map,
                                                 const ProbeGridSettings& settings,
                                                 std::vector<PlacedProbe>& probes);

}  // namespace tetralight
