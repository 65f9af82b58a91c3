// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include <tetralight/base/result.h>

namespace tetralight::detail {

[[nodiscard]] bool is_glb(std::span<const std::byte> bytes);

/// The JSON chunk of a .glb file. All chunks are measured, since tinygltf reads past the end of a
/// last chunk that claims a few bytes too many.
[[nodiscard]] Result<std::span<const std::byte>> glb_json(std::span<const std::byte> bytes);

}  // namespace tetralight::detail
