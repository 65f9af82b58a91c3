// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <tetralight/base/result.h>
#include <tetralight/cli/query_position.h>

namespace tetralight::cli {

/// A number as its digits stand in the input; the nearest float.
/// Returns invalid_argument if the digits are not a number, and corrupt with its `name` if no float
/// holds it.
/// `length` is set to the digits that were taken.
[[nodiscard]] Result<float> parse_coordinate(std::string_view digits, const char* name,
                                             size_t& length);

/// Three numbers, or six with a normal, with blanks, or one comma, between two of them. Errors show
/// the line.
[[nodiscard]] Result<QueryPosition> parse_position(std::string_view line, Normals normals);

/// Input as messages show it: not too long.
[[nodiscard]] std::string shown(std::string_view input);

}  // namespace tetralight::cli
