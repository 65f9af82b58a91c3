// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/pipeline/bake_volume.h>

namespace tetralight {

/// Joins parts of one bake, in any order, to the volume that one bake of all probes gives, byte for
/// byte. Each probe has to be in one part. Errors name the files and the ranges: a file that cannot
/// be read or is no part, parts of different bakes, unfinished ones, overlaps, gaps.
/// Precondition: at least one path.
[[nodiscard]] Result<BakedVolume> merge_parts(const std::vector<std::string>& paths);

}  // namespace tetralight
