// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/probes/build/merge.h>

namespace tetralight {

/// For each of the given probes the distance to the nearest other probe of one of its groups,
/// metres; infinite if there is none. Other groups do not count, so adding one changes nothing.
[[nodiscard]] std::vector<double> group_spacing(const MergedProbes& merged,
                                                std::span<const uint32_t> probes);

}  // namespace tetralight
