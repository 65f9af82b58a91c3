// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <tetralight/base/result.h>

// What docs/file_format.md says of the sections that hold text. Errors name the section.

namespace tetralight::detail {

/// UTF-8, each name ended by a line break.
[[nodiscard]] Status check_names(std::string_view section, std::string_view names);

/// The same, and sorted without duplicates.
[[nodiscard]] Status check_sorted_names(std::string_view section, std::string_view names);

/// A JSON object, or nothing.
[[nodiscard]] Status check_metadata(std::string_view metadata);

}  // namespace tetralight::detail
