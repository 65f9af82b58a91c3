// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// The seed grid of a volume (probes/seed_grid.h), whose positions, cells and hull rays are
/// complete. About four voxels a probe: a voxel that holds many probes has a finer grid around
/// them. Empty if there are no cells.
[[nodiscard]] std::vector<uint32_t> make_seed_grid(const ProbeVolumeView& volume);

}  // namespace tetralight
