// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include <tetralight/verify/verify_report.h>

// Pictures of a report as inline SVG elements. Their colours are variables of the page's style
// sheet. Each has a title that says what it shows, for screen readers.

namespace tetralight {

/// Elements that a chart shows at most: those with the largest differences.
inline constexpr size_t kMostChartElements = 3000;

/// Decided probes by z in one channel (0 to 2), beside the normal distribution.
[[nodiscard]] std::string z_histogram(const VerifyReport& report, size_t channel);

/// Light of the volume over that of the referee at probes, in one channel, with bars of three
/// standard errors, on logarithmic axes.
[[nodiscard]] std::string light_scatter(const VerifyReport& report, size_t channel);

/// Probes from above, coloured by the z of the channel in which it is largest.
[[nodiscard]] std::string probe_map(const VerifyReport& report);

/// Places from above, coloured by the difference of luminance over the mean light.
[[nodiscard]] std::string place_map(const VerifyReport& report);

/// The z of the decided channel in which it is largest; 0 if no channel is decided.
[[nodiscard]] double largest_z(const VerifyProbe& probe) noexcept;

/// (answer − traced) of luminance.
[[nodiscard]] double luminance_difference(const VerifyPlace& place) noexcept;

}  // namespace tetralight
