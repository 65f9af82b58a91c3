// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/bake/scene/detail/part_list.h>

namespace tetralight::detail {

/// Adds the animations of a document, what they animate that is not read, and the nodes that skins
/// and morph targets deform. `animation` is the one that the nodes stand in; empty: none.
void add_motion_parts(const GltfDocument& document, std::span<const GltfWorldNode> nodes,
                      std::optional<uint32_t> animation, PartList& parts);

}  // namespace tetralight::detail
