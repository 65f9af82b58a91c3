// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// A .gltf holds JSON alone; a .glb holds JSON and the bytes of its first buffer.
enum class GltfContainer { Gltf, Glb };

/// Parses and checks the JSON of a glTF file, with skies as gltf_sky.h writes them: that it is well
/// formed and not nested too deep, that each property that read_gltf() uses has its type, that each
/// index is in range, and that buffer views lie in their buffers. Returns corrupt otherwise, and
/// unsupported if the file requires an extension that is not read. Error fields are complete:
/// `bufferViews[3].byteLength`.
[[nodiscard]] Result<nlohmann::json> parse_gltf_json(std::string_view json_text,
                                                     GltfContainer container);

}  // namespace tetralight::detail
