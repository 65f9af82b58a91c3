// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// A .gltf holds JSON alone; a .glb holds JSON and the bytes of its first buffer.
enum class GltfContainer { Gltf, Glb };

/// Checks what tinygltf takes on trust: that the JSON is well formed and not nested too deep, that
/// each property read_gltf() uses has its type, that each index is in range, that buffer views lie
/// in their buffers, and that no required extension is unknown.
[[nodiscard]] Status check_gltf_json(std::string_view json_text, GltfContainer container);

}  // namespace tetralight::detail
