// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/settings/values.h>

// What values from texts and from JSON share: ranges, and the messages about them.

namespace tetralight::settings::detail {

[[nodiscard]] Error invalid(std::string_view value, std::string_view message);

/// `"x" is not a number`.
[[nodiscard]] Error not_a(std::string_view value, std::string_view what);

/// Returns an error if the number is not finite or outside of the setting's range. `shown` is the
/// number as messages say it.
[[nodiscard]] Result<Json> checked_number(const Setting& setting, double number,
                                          std::string_view shown);

/// The same for whole numbers; no number is an error, too.
[[nodiscard]] Result<Json> checked_integer(const Setting& setting, std::optional<uint64_t> number,
                                           std::string_view shown);

/// The words of a list that is separated by blanks (`Setting::choices`).
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view list);

/// Words with commas between, each in quotes.
[[nodiscard]] std::string joined(const std::vector<std::string_view>& words,
                                 std::string_view quote);

}  // namespace tetralight::settings::detail
