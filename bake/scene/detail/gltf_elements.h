// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <tetralight/bake/scene/detail/gltf_document.h>

namespace tetralight::detail {

/// The elements of a glTF document as plain values, without its buffers, its path and the default
/// scene. Precondition: the document passed check_gltf_json().
[[nodiscard]] GltfDocument document_from(const nlohmann::json& source);

/// Sets what `document` says of one scene, whose index is in range. A document without scenes stays
/// as it is.
void choose_scene(const nlohmann::json& source, uint32_t scene, GltfDocument& document);

}  // namespace tetralight::detail
