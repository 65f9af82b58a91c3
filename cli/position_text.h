// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include <tetralight/base/result.h>

namespace tetralight::cli {

/// A number as its digits stand in the input; the nearest float, 0 where there is none but 0.
/// Errors: no number (an empty message), and `x is 1e39, beyond what a float holds` with `axis`.
/// `length` is set to the digits that were taken.
[[nodiscard]] Result<float> parse_coordinate(std::string_view digits, char axis, size_t& length);

/// Three numbers with blanks, or one comma, between two of them. Errors show the line.
[[nodiscard]] Result<glm::vec3> parse_position(std::string_view line);

/// Input as messages show it: not too long.
[[nodiscard]] std::string shown(std::string_view input);

}  // namespace tetralight::cli
