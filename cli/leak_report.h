// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/cli/common.h>
#include <tetralight/pipeline/check_leaks.h>

// Light through walls, as `check-leaks` and `bake` report it.

namespace tetralight::cli {

/// Shares of the mean light, and the worst places.
[[nodiscard]] Json to_json(const LeakReport& report);

/// The same as lines for people, without a line break at the end.
[[nodiscard]] std::string to_text(const LeakReport& report);

}  // namespace tetralight::cli
