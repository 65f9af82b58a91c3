// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tetralight {

/// The candidate that is nearest to a misspelled word: by insertions, deletions, changes and swaps
/// of letters, at most a third of the word's length; a candidate that begins with the word counts
/// as near. Empty if none is near.
[[nodiscard]] std::string closest(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean X?", or nothing.
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       std::span<const std::string> candidates);

}  // namespace tetralight
