// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/bake/scene/detail/part_list.h>

namespace tetralight::detail {

/// Adds the animations of a document, what they animate that is not read, and the nodes that skins
/// and morph targets deform.
void add_motion_parts(const GltfDocument& document, std::span<const GltfWorldNode> nodes,
                      PartList& parts);

}  // namespace tetralight::detail
