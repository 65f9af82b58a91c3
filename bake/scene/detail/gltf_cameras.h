// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/bake/scene/detail/part_list.h>

namespace tetralight::detail {

/// The scene's perspective and orthographic cameras; others are left out. A camera is named after
/// its node, or else by its own name. Those that are scaled to 0 along some axis are left out and
/// added to `parts`.
[[nodiscard]] std::vector<Camera> read_cameras(const GltfDocument& document,
                                               std::span<const GltfWorldNode> nodes,
                                               PartList& parts);

}  // namespace tetralight::detail
