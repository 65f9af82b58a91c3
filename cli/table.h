// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tetralight::cli {

/// Rows of text as lines with aligned columns, two blanks between them. `alignment` has a letter a
/// column: 'l' or 'r'; a row may be shorter. Widths are counted in UTF-8 characters.
[[nodiscard]] std::string aligned(const std::vector<std::vector<std::string>>& rows,
                                  const std::string& alignment);

}  // namespace tetralight::cli
