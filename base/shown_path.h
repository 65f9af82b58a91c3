// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tetralight {

/// A path as messages show it, in one line: control characters and bytes that are not UTF-8 as
/// `\x1b`, an empty path as `""`, a very long one shortened in the middle.
[[nodiscard]] std::string shown_path(std::string_view path);

}  // namespace tetralight
