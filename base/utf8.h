// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <tetralight/base/result.h>

namespace tetralight {

/// Whether bytes are UTF-8 (RFC 3629): no overlong forms, no surrogates, nothing beyond U+10FFFF.
[[nodiscard]] bool is_utf8(std::string_view bytes) noexcept;

/// Whether there is a line break or another control character of ASCII.
[[nodiscard]] bool has_control_character(std::string_view text) noexcept;

/// Refuses what no name of a group, a light or a layer may hold: control characters, and bytes that
/// are not UTF-8.
[[nodiscard]] Status check_characters(std::string_view name);

}  // namespace tetralight
