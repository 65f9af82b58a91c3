// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/probes/build/cut_world.h>

namespace tetralight {

/// What a world has.
struct WorldSummary {
    WorldInfo info;
    /// With the tile outside.
    uint32_t tile_count = 0;
    /// Sums over tiles: probes and cells that several tiles hold count in each.
    uint64_t probe_count = 0;
    uint64_t cell_count = 0;
    uint64_t size = 0;  ///< of all files, bytes
    uint64_t largest_tile_size = 0;
    uint64_t outside_tile_size = 0;
};

/// Called after each tile; false stops the work.
using WorldProgress = std::function<bool(uint32_t done, uint32_t count)>;

/// The sides of cubes that cut a volume into tiles of about so many probes. Precondition: count >
/// 0.
[[nodiscard]] double tile_side_for(const ProbeVolumeView& volume, uint64_t probes_a_tile);

/// Cuts a volume into a folder: a file for each tile, named after its content, and the index. The
/// index is replaced last, by renaming, and files of an older world are deleted after that: at any
/// time the folder holds a whole world.
///
/// Returns the errors of `WorldCutter::make`; invalid_argument if the path is not a folder, or one
/// of other files; the reason why a file cannot be written; cancelled if `progress` says so.
/// Precondition: the volume passes `verify`.
[[nodiscard]] Result<WorldSummary> write_world(const std::string& folder,
                                               const ProbeVolumeView& volume,
                                               const WorldSettings& settings,
                                               const WorldProgress& progress = {});

/// The same of the index of a world that is there.
[[nodiscard]] WorldSummary summary_of(const WorldIndexView& index);

}  // namespace tetralight
