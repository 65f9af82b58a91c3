// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/result.h"
#include "cli/byte_reader.h"
#include "cli/position_chunks.h"
#include "cli/query_formats.h"

namespace tetralight::cli {

/// Reads positions to the end, in constant memory. Those before an error are answered; the error
/// names the input, the line, element or record, and what stands there.
[[nodiscard]] Status read_positions(ByteReader& reader, PositionFormat format,
                                    PositionChunks& chunks);

}  // namespace tetralight::cli
