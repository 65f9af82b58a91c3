// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/cli/common.h>
#include <tetralight/pipeline/check_leaks.h>

// Light through walls, as `check-leaks` and `bake` report it.

namespace tetralight::cli {

/// Shares of the mean light, and the worst places.
[[nodiscard]] Json to_json(const LeakReport& report);

/// All places, in the order of the report.
[[nodiscard]] Json all_places_json(const LeakReport& report);

/// The same as lines for people, without a line break at the end.
[[nodiscard]] std::string to_text(const LeakReport& report);

/// "0.0012 %", "1.23 %", "12.3 %": shares of light through walls are often tiny.
[[nodiscard]] std::string share_text(double share);

}  // namespace tetralight::cli
