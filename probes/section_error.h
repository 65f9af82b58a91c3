// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <tetralight/base/error.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {

/// Corrupt: what is wrong with a section of a file.
[[nodiscard]] inline Error section_error(std::string_view section, const std::string& what) {
    return {ErrorCode::Corrupt, std::string(section), "",
            str_cat("section \"", section, "\": ", what)};
}

/// Corrupt: what is wrong with one element of a section.
[[nodiscard]] inline Error element_error(std::string_view section, size_t element,
                                         const std::string& what) {
    return {ErrorCode::Corrupt, str_cat(section, "[", element, "]"), "",
            str_cat("section \"", section, "\": element ", element, ": ", what)};
}

}  // namespace tetralight::detail
