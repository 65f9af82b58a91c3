// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>

namespace tetralight::detail {

/// The scene's perspective and orthographic cameras; others are left out. A camera is named after
/// its node, or else by its own name. Leaves out those that are scaled to 0 along some axis, with a
/// warning.
[[nodiscard]] std::vector<Camera> read_cameras(const GltfDocument& document,
                                               std::span<const GltfWorldNode> nodes,
                                               std::vector<std::string>& warnings);

}  // namespace tetralight::detail
