// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace tetralight::server {

/// What is kept of things that nobody gave a name: the newest ones, or those younger than an age.
struct Keep {
    std::optional<uint64_t> count = {};
    std::optional<double> seconds = {};

    [[nodiscard]] bool is_limited() const { return count || seconds; }

    /// True if something that was made at `time`, and that `newer` others are newer than, must go.
    [[nodiscard]] bool is_over(double time, size_t newer, double now) const;
};

/// Reads "100" or "30d" ("12h", "90m", "45s"). Nothing for any other text.
[[nodiscard]] std::optional<Keep> parse_keep(const std::string& text);

}  // namespace tetralight::server
