// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tetralight::cli {

/// Rows of text as lines with aligned columns, two blanks between them. `alignment` has a letter a
/// column: 'l' or 'r'; a row may be shorter. Widths are counted in UTF-8 characters.
[[nodiscard]] std::string aligned(const std::vector<std::vector<std::string>>& rows,
                                  const std::string& alignment);

/// Appends the words of a text and a line break, and begins a line at `indent` before a word that
/// would pass column 96.
void append_wrapped(std::string& text, std::string_view words, size_t indent);

/// At most `longest` UTF-8 characters of a text; the last is "…" if there were more.
[[nodiscard]] std::string shortened(const std::string& text, size_t longest);

}  // namespace tetralight::cli
