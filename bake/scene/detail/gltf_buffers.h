// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The bytes of a data URI in base64: `data:TYPE;base64,BYTES`, of any type. Returns unsupported
/// for other data URIs and corrupt for characters that are not base64.
[[nodiscard]] Result<std::vector<std::byte>> decode_data_uri(std::string_view uri);

/// True if the buffer has no bytes of its own: it only says how long its views are when decoded
/// (EXT_meshopt_compression).
[[nodiscard]] bool is_fallback_buffer(const nlohmann::json& buffer);

/// The bytes of all buffers of a document, each of its `byteLength`: from data URIs, from files
/// beside the scene's, or from the binary chunk of a .glb file. Empty for fallback buffers.
/// Precondition: the document passed parse_gltf_json().
[[nodiscard]] Result<std::vector<std::vector<std::byte>>> read_buffers(
    const nlohmann::json& document, const std::string& scene_path,
    std::optional<std::span<const std::byte>> binary_chunk);

}  // namespace tetralight::detail
