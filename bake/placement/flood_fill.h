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

/// What flood fill found.
struct FloodFill {
    /// One a probe that is kept.
    std::vector<uint32_t> spaces;
    std::vector<DroppedSpace> dropped_spaces;
    /// The spaces to fill, sorted. Where other spaces are kept it is only those of probes.
    std::vector<uint32_t> wanted;
    /// All spaces that have probes, kept or dropped, sorted.
    std::vector<uint32_t> filled;
};

/// Drops the probes that cannot be reached from the seeds, or from the space that most probes are
/// in, when other spaces are not kept. Joins in the map what probes and seeds see. Error: a seed
/// inside geometry, out of bounds or in a gap that the map has no post in.
[[nodiscard]] Result<FloodFill> drop_unreachable(const TraceScene& traced, FreeSpaceMap& map,
                                                 const ProbeGridSettings& settings,
                                                 std::vector<PlacedProbe>& probes);

}  // namespace tetralight
