// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/probes/build/merge.h>

namespace tetralight {

/// How far each of some probes is from the nearest other probe of a group that it belongs to,
/// metres; infinite when it is alone there. Other groups have no say, so that adding one changes
/// nothing.
[[nodiscard]] std::vector<double> group_spacing(const MergedProbes& merged,
                                                std::span<const uint32_t> probes);

}  // namespace tetralight
