// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/cli/byte_reader.h>
#include <tetralight/cli/position_chunks.h>
#include <tetralight/cli/query_formats.h>

namespace tetralight::cli {

/// Reads positions to the end, in constant memory. Those before an error are answered; the error
/// names the input, the line, element or record, and its value.
[[nodiscard]] Status read_positions(ByteReader& reader, PositionFormat format,
                                    PositionChunks& chunks);

}  // namespace tetralight::cli
