// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <tetralight/cli/values.h>

// Amounts as people write them.

namespace tetralight::cli {

/// Elements [begin, end).
struct IndexRange {
    uint32_t begin = 0;
    uint32_t end = std::numeric_limits<uint32_t>::max();  ///< the largest: to the last one

    bool operator==(const IndexRange&) const = default;
};

/// A setting of type Range; none if it was not given.
[[nodiscard]] std::optional<IndexRange> index_range(const Values& values, std::string_view name);

/// "1.25 %", two or three digits.
[[nodiscard]] std::string percent(double fraction);

/// "a, b, c".
[[nodiscard]] std::string joined(const std::vector<std::string>& words);

}  // namespace tetralight::cli
