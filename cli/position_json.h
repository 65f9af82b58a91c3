// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <tetralight/base/result.h>
#include <tetralight/cli/byte_reader.h>
#include <tetralight/cli/position_chunks.h>

namespace tetralight::cli {

/// Reads an array of positions while it is parsed, in constant memory. A position is [x, y, z] or
/// an object whose "position" is that; its other keys are left alone. With normals it is [x, y, z,
/// nx, ny, nz] or an object with "position" and "normal". Errors name the input and the position,
/// counted from 0.
[[nodiscard]] Status read_json(ByteReader& reader, PositionChunks& chunks);

/// One position.
[[nodiscard]] Result<QueryPosition> parse_json_position(std::string_view line, Normals normals);

}  // namespace tetralight::cli
