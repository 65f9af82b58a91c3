// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

// Text of HTML pages and SVG pictures.

namespace tetralight {

/// Text for an element or a quoted attribute: `& < > " '` as entities, control characters and marks
/// that change the direction of text as `\u001b`, and U+FFFD for each byte that is not UTF-8.
[[nodiscard]] std::string escape_html(std::string_view text);

/// `data:TYPE;base64,BYTES`.
[[nodiscard]] std::string data_uri(std::string_view type, std::span<const std::byte> bytes);

/// A number with `digits` significant digits.
[[nodiscard]] std::string significant(double number, int digits = 4);

/// A number with `decimals` decimals.
[[nodiscard]] std::string fixed_point(double number, int decimals);

/// A fraction as "1.25 %".
[[nodiscard]] std::string percent_text(double fraction);

/// `<NAME>CONTENT</NAME>`. The content is HTML already; the name may have attributes.
[[nodiscard]] std::string element(std::string_view name_and_attributes, std::string_view content);

/// A table with a caption. The first cell of each row is its heading. Texts are escaped.
class HtmlTable {
  public:
    HtmlTable(std::string_view caption, std::span<const std::string> headings);

    void add_row(std::span<const std::string> cells);

    [[nodiscard]] std::string html() const;

  private:
    std::string text_;
};

}  // namespace tetralight
