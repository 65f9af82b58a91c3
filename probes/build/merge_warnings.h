// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/probes/build/merge.h>

namespace tetralight {

/// What a user may not expect of merged probes and the dimension of their volume, one line each:
/// groups without a probe, no probes at all, most probes welded, a set that counts as flat although
/// it is not. A set within 1e-6 of its size from a plane (a line) was meant to be flat.
[[nodiscard]] std::vector<std::string> merge_warnings(const MergedProbes& probes,
                                                      Dimension dimension);

}  // namespace tetralight
