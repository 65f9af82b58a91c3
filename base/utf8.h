// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <tetralight/base/result.h>

namespace tetralight {

/// True if bytes are UTF-8 (RFC 3629): no overlong forms, surrogates or values above U+10FFFF.
[[nodiscard]] bool is_utf8(std::string_view bytes) noexcept;

/// True if the text holds a line break or another control character (C0, DEL, C1 in UTF-8).
[[nodiscard]] bool has_control_character(std::string_view text) noexcept;

/// Returns invalid_argument if the name of a group, a light or a layer holds a control character or
/// is not UTF-8.
[[nodiscard]] Status check_characters(std::string_view name);

}  // namespace tetralight
