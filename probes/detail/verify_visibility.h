// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// Checks the sections "visibility_blocks" and "cell_visibility": a block for each 32 cells, as
/// many elements as cells are marked, and in each element an edge that is not free.
[[nodiscard]] Status check_visibility(const ProbeVolumeView& volume);

}  // namespace tetralight::detail
