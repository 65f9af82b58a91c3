// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/probes/build/merge.h>

namespace tetralight {

/// Removes the marked probes and keeps the order of the others. The sources of removed probes stay,
/// with `kNoIndex` for their probe, so that every probe of every group has an entry. Precondition:
/// one flag a probe.
[[nodiscard]] MergedProbes remove_probes(MergedProbes probes, const std::vector<bool>& is_removed);

}  // namespace tetralight
