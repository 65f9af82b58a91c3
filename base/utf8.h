// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <tetralight/base/result.h>

namespace tetralight {

/// True if bytes are UTF-8 (RFC 3629): no overlong forms, surrogates or values above U+10FFFF.
[[nodiscard]] bool is_utf8(std::string_view bytes) noexcept;

/// True if the text holds a line break or another control character (C0, DEL, C1 in UTF-8).
[[nodiscard]] bool has_control_character(std::string_view text) noexcept;

/// The text with control characters (C0, DEL, C1) and the marks that change the direction of text
/// (U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069) as `\u001b`: a terminal obeys them.
[[nodiscard]] std::string without_controls(std::string_view text);

/// The text with a blank in place of each control character (C0, DEL, C1).
[[nodiscard]] std::string with_blanks_for_controls(std::string_view text);

/// Returns invalid_argument if the name of a group, a light or a layer holds a control character or
/// is not UTF-8.
[[nodiscard]] Status check_characters(std::string_view name);

}  // namespace tetralight
