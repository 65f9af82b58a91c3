// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/probes/build/merge.h>

namespace tetralight {

/// The probes that are not to be left out, in the same order. Sources of those that are left out
/// stay, with `kNoIndex` for their probe, so that every probe of every group is accounted for.
/// Precondition: one flag a probe.
[[nodiscard]] MergedProbes remove_probes(MergedProbes probes, const std::vector<bool>& is_left_out);

}  // namespace tetralight
