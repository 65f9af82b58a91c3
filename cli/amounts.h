// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

// Options whose values are written as people write them.

namespace tetralight::cli {

/// A share of something: "1%" or "0.01", above 0 and up to 1. Nothing: it is written otherwise.
[[nodiscard]] std::optional<double> parse_share(const std::string& text);

/// Seconds: "90", "90s", "1.5m", "2h"; above 0. Nothing: it is written otherwise.
[[nodiscard]] std::optional<double> parse_time(const std::string& text);

/// Elements [begin, end).
struct IndexRange {
    uint32_t begin = 0;
    uint32_t end = std::numeric_limits<uint32_t>::max();  ///< the largest: to the last one

    bool operator==(const IndexRange&) const = default;
};

/// "100..200", or "100.." for all from 100 on; not empty. Nothing: it is written otherwise.
[[nodiscard]] std::optional<IndexRange> parse_range(const std::string& text);

CLI::Option* add_share(CLI::App& command, const std::string& name, double& share,
                       const std::string& help);
CLI::Option* add_time(CLI::App& command, const std::string& name, double& seconds,
                      const std::string& help);
CLI::Option* add_range(CLI::App& command, const std::string& name, std::optional<IndexRange>& range,
                       const std::string& help);

/// "1.25 %", two or three digits.
[[nodiscard]] std::string percent(double share);

/// "a, b, c".
[[nodiscard]] std::string joined(const std::vector<std::string>& words);

}  // namespace tetralight::cli
