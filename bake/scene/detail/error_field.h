// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <tetralight/base/error.h>

// The readers of files name the member that is at fault: `nodes[3].extras.spacing`. A function that
// reads a part of the file gives a field relative to that part, which begins with '.' or '['; its
// callers complete it.

namespace tetralight::detail {

/// The same error with its field completed: `.extras.spacing` in `nodes[3]` becomes
/// `nodes[3].extras.spacing`. An empty field becomes `member`. A field that is complete stays.
/// The file itself is the member "".
[[nodiscard]] inline Error in_member(Error error, std::string_view member) {
    const bool is_relative =
        error.field.empty() || error.field.front() == '.' || error.field.front() == '[';
    if (is_relative) error.field.insert(0, member);
    if (member.empty() && error.field.starts_with('.')) error.field.erase(0, 1);
    return error;
}

/// A value as errors quote it: `text` of at most 80 characters.
[[nodiscard]] inline std::string quoted_value(std::string_view text) {
    return std::string(text.substr(0, 80));
}

}  // namespace tetralight::detail
