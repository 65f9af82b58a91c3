// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight {

/// True if the bytes begin like a .glb file.
[[nodiscard]] bool is_glb(std::span<const std::byte> bytes);

/// The chunks of a .glb file.
struct GlbChunks {
    std::span<const std::byte> json;
    /// Empty if there is none.
    std::optional<std::span<const std::byte>> binary;
};

/// Returns corrupt if any chunk does not fit into the file.
[[nodiscard]] Result<GlbChunks> glb_chunks(std::span<const std::byte> bytes);

/// A .glb file of this JSON and this binary chunk, which may be empty. Returns unsupported for more
/// bytes than the format can count.
[[nodiscard]] Result<std::vector<std::byte>> make_glb(std::string json,
                                                      std::span<const std::byte> binary);

}  // namespace tetralight
