// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <tetralight/base/result.h>

// Checks the sections that hold text as docs/file_format.md specifies them. They return corrupt;
// the field is the section.

namespace tetralight::detail {

/// UTF-8, each name ended by a line break.
[[nodiscard]] Status check_names(std::string_view section, std::string_view names);

/// The same, and no name occurs twice.
[[nodiscard]] Status check_distinct_names(std::string_view section, std::string_view names);

/// The same, and sorted.
[[nodiscard]] Status check_sorted_names(std::string_view section, std::string_view names);

/// UTF-8 without control characters other than the white space of JSON. Offline code checks that
/// it is a JSON object (base/json/check_metadata.h).
[[nodiscard]] Status check_metadata_text(std::string_view metadata);

}  // namespace tetralight::detail
