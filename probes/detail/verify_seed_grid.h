// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// Checks the section "seed_grid": whole grids, each named by voxels of grids before it, and
/// cells in range.
[[nodiscard]] Status check_seed_grid(const ProbeVolumeView& volume);

}  // namespace tetralight::detail
