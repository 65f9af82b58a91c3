// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/bake_volume.h>

namespace tetralight {

/// Joins parts of one bake, in any order. The volume has the bytes of one bake of all probes. Each
/// probe has to be in exactly one part. Returns invalid_argument, with the names of files and
/// ranges, for a file that is not a part, parts of different bakes, parts of lightmaps, overlaps
/// and gaps. The report has what the parts keep of the bake's: no times, and no rays of walls.
/// Precondition: at least one path.
[[nodiscard]] Result<BakedVolume> merge_parts(const std::vector<std::string>& paths);

/// The same for parts of a prepared bake (`write_light_part`), of which one is in memory at a time.
/// Precondition: at least one path.
[[nodiscard]] Result<BakedVolume> merge_light_parts(const std::string& prepared_path,
                                                    const std::vector<std::string>& paths);

/// The same for parts of lightmaps, whose texels have to be in exactly one part. The report has no
/// times and no warnings of UVs and lights. `thread_count`: 0 = all.
[[nodiscard]] Result<BakedLightmaps> merge_lightmap_parts(const std::vector<std::string>& paths,
                                                          uint32_t thread_count = 0);

}  // namespace tetralight
