// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tetralight::detail {

/// The name that a word probably stands for, whatever its case, dashes and spaces; empty if there
/// is none.
[[nodiscard]] std::string meant_name(std::string_view word, std::span<const std::string> names);

}  // namespace tetralight::detail
