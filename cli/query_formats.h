// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

// The forms in which `query` takes positions and gives answers; docs/query.md describes them.

namespace tetralight::cli {

/// In the order of the choices of `from`. With normals there are six numbers instead of three.
enum class PositionFormat : uint8_t {
    Text,       ///< x y z a line, # begins a comment
    JsonArray,  ///< an array of [x, y, z] or {"position": [x, y, z]}
    JsonLines,  ///< one of these a line
    Raw,        ///< three little-endian float32 each
};

/// In the order of the choices of `to`.
enum class AnswerFormat : uint8_t {
    Text,       ///< a line for people
    JsonLines,  ///< an object a line
    Csv,        ///< a header, then a line each
    Raw,        ///< `RawAnswer`, 128 bytes each
};

/// By the extension of a file; text if it is unknown.
[[nodiscard]] PositionFormat position_format_of_file(const std::string& path);

/// By the extension of a file; none if it has no extension or an unknown one.
[[nodiscard]] std::optional<AnswerFormat> answer_format_of_file(const std::string& path);

}  // namespace tetralight::cli
