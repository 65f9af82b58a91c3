// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// A volume of some probes of another one, in the order of `probes`, with all that it holds for
/// them and for the volume as a whole; without cells, seeds and visibility. `places`: the place of
/// each probe of the volume in `probes`, or kNoIndex.
[[nodiscard]] ProbeVolume select_probes(const ProbeVolumeView& volume,
                                        std::span<const uint32_t> probes,
                                        std::span<const uint32_t> places);

/// Copies what is known of walls in `cells`, indices of cells of another volume, to the cells of
/// `part` that are as many, in their order. The part may have more cells.
void select_visibility(const ProbeVolumeView& volume, std::span<const uint32_t> cells,
                       ProbeVolume& part);

}  // namespace tetralight::detail
