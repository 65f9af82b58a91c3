// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace tetralight::server {

// Rules for names that people read. Names that look alike must not differ only by characters that
// nobody can see, and must not change how the text around them is shown.

/// True if the text begins or ends with a space of any script, or consists of spaces.
[[nodiscard]] bool has_outer_space(std::string_view utf8) noexcept;

/// True if the text has a control character of Unicode (C1), one that is invisible, or one that
/// changes the direction of text. Precondition: valid UTF-8.
[[nodiscard]] bool has_hidden_character(std::string_view utf8) noexcept;

}  // namespace tetralight::server
