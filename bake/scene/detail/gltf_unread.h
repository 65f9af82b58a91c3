// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/part_list.h>

namespace tetralight::detail {

/// Adds what a document has besides what read_gltf() reads: its extensions, members of glTF that
/// are left out, other scenes, and nodes outside of the scene. Precondition: `source` passed
/// parse_gltf_json(), and `document` is made from it.
void add_unread_parts(const nlohmann::json& source, const GltfDocument& document, PartList& parts);

}  // namespace tetralight::detail
