// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/probes/probe_volume.h>

namespace tetralight::portability {

/// Joins the exact positions of a volume again. True if all cells are those of the volume: exact
/// arithmetic gives the same on every platform.
[[nodiscard]] bool cells_are_the_same(const ProbeVolumeView& volume);

}  // namespace tetralight::portability
