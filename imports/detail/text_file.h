// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <tetralight/base/file.h>
#include <tetralight/base/result.h>

// What the readers of text files share.

namespace tetralight::detail {

/// The longest name of a group that is read, in bytes. The names of groups repeat those of their
/// parents, so that without a limit a small file could need any amount of memory.
inline constexpr size_t kLongestGroupName = 4096;

/// A file of UTF-8 in memory.
class TextFile {
  public:
    /// Returns unsupported for more than 4 GiB, and corrupt, with the line, if the file is not
    /// UTF-8.
    [[nodiscard]] static Result<TextFile> open(const std::string& path);

    /// Without the byte order mark. Valid as long as this object.
    [[nodiscard]] std::string_view text() const { return text_; }

  private:
    MappedFile file_;
    std::string_view text_;
};

/// `"text"` as messages quote it: 60 bytes at most, without control characters.
[[nodiscard]] std::string quoted_text(std::string_view text);

/// With the letters a to z in place of A to Z.
[[nodiscard]] std::string in_lower_case(std::string text);

/// The number that the whole text is, with or without a sign. Returns corrupt, with `name` as the
/// field, if it is anything else, too large for a double, or not finite.
[[nodiscard]] Result<double> parse_number(std::string_view text, std::string_view name);

/// Returns corrupt if the name of a group is empty or longer than `kLongestGroupName`.
[[nodiscard]] Status check_group_name(std::string_view name);

}  // namespace tetralight::detail
