// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// The forms in which `query` takes positions and gives answers; docs/query.md describes them.

namespace tetralight::cli {

enum class PositionFormat : uint8_t {
    Text,       ///< x y z a line, # begins a comment
    Json,       ///< an array of [x, y, z] or {"position": [x, y, z]}
    JsonLines,  ///< one of these a line
    Raw,        ///< three little-endian float32 each
};

enum class AnswerFormat : uint8_t {
    Text,       ///< a line for people
    JsonLines,  ///< an object a line
    Csv,        ///< a header, then a line each
    Raw,        ///< `RawAnswer`, 128 bytes each
};

/// The words of `--from` and `--to`.
[[nodiscard]] std::vector<std::string> position_format_names();
[[nodiscard]] std::vector<std::string> answer_format_names();

/// Precondition: `name` is one of the words.
[[nodiscard]] PositionFormat position_format(const std::string& name);
[[nodiscard]] AnswerFormat answer_format(const std::string& name);

/// What the extension of a file says; files of any other are text.
[[nodiscard]] PositionFormat position_format_of_file(const std::string& path);

/// What the extension of a file says. None: it has no extension, or one of another format.
[[nodiscard]] std::optional<AnswerFormat> answer_format_of_file(const std::string& path);

}  // namespace tetralight::cli
