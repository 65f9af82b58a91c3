// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/probes/build/merge.h>

namespace tetralight {

/// Warnings about merged probes and the dimension of their volume, one line each:
/// groups without a probe, no probes at all, most probes welded, a set that is treated as flat
/// although it is not: one that deviates from a plane (a line) by more than 1e-6 of its size.
[[nodiscard]] std::vector<std::string> merge_warnings(const MergedProbes& probes,
                                                      Dimension dimension);

}  // namespace tetralight
