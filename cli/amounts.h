// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <tetralight/cli/values.h>
#include <tetralight/pipeline/place_range.h>

// Amounts as people write them.

namespace tetralight::cli {

/// The `end` of a range to the last place.
constexpr uint32_t kLastPlace = std::numeric_limits<uint32_t>::max();

/// A setting of type Range; none if it was not given.
[[nodiscard]] std::optional<PlaceRange> place_range(const Values& values, std::string_view name);

/// "1.25 %", two or three digits.
[[nodiscard]] std::string percent(double fraction);

/// "a, b, c".
[[nodiscard]] std::string joined(const std::vector<std::string>& words);

}  // namespace tetralight::cli
