// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <optional>
#include <string>
#include <string_view>

#include <tetralight/base/result.h>

// Checks of JSON text before it is parsed or stored.

namespace tetralight {

/// The deepest nesting of arrays and objects that is accepted: far more than real files have. Much
/// code that handles JSON calls itself once a level.
inline constexpr int kDeepestJson = 64;

/// The largest number of members of one object that is accepted. Objects that keep the order of
/// their members search them one after the other.
inline constexpr int kMostJsonMembers = 4096;

/// Returns an error if JSON is nested deeper than `kDeepestJson`, or an object has more than
/// `kMostJsonMembers` members. It counts brackets and colons outside of strings and finds no other
/// errors.
[[nodiscard]] Status check_json_shape(std::string_view json);

/// Returns an error unless the text is one JSON object (RFC 8259) in UTF-8, not nested too deep.
[[nodiscard]] Status check_json_object(std::string_view json);

/// The first key that an object of the text has twice. Parsers differ in which of the values they
/// take. Precondition: the text is JSON (RFC 8259), not nested too deep.
[[nodiscard]] std::optional<std::string> find_duplicate_key(std::string_view json);

/// The message of an exception of nlohmann-json without its tag, `[json.exception...] `.
[[nodiscard]] std::string json_error_reason(const std::exception& exception);

}  // namespace tetralight
