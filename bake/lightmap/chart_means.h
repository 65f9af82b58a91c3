// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/lightmap/page_charts.h>

namespace tetralight {

/// Means of the values of texels over squares of up to (2 radius + 1)² texels around each: those of
/// its chart, and of others across seams. 0 for texels of no chart. A function of the arguments
/// alone, for any number of threads.
[[nodiscard]] std::vector<double> chart_means(const PageCharts& pages,
                                              std::span<const double> values, int radius,
                                              uint32_t thread_count);

}  // namespace tetralight
