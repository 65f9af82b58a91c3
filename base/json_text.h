// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>
#include <string_view>

#include <tetralight/base/result.h>

// What text has to obey before it is given to a JSON library, or stored for others to read.

namespace tetralight {

/// Arrays and objects within each other; no real file nests nearly as deep, and much code that
/// handles JSON calls itself for each level.
inline constexpr int kDeepestJson = 64;

/// Refuses JSON that is nested deeper than `kDeepestJson`. It counts brackets outside of strings
/// and leaves other errors to whoever parses the text.
[[nodiscard]] Status check_json_depth(std::string_view json);

/// Refuses what is not one JSON object (RFC 8259) in UTF-8, or is nested too deep.
[[nodiscard]] Status check_json_object(std::string_view json);

/// The message of an exception of nlohmann-json without its tag, `[json.exception...] `.
[[nodiscard]] std::string json_error_reason(const std::exception& exception);

}  // namespace tetralight
