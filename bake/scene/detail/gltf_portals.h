// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The rectangles of `extras.portal`: around the origin of their nodes, width along X and height
/// along Y, with the scale of the node. Returns invalid_argument if one has no area, or
/// reaches farther than 1e12 m from the origin.
[[nodiscard]] Result<std::vector<Portal>> read_gltf_portals(const GltfDocument& document,
                                                            std::span<const GltfWorldNode> nodes);

}  // namespace tetralight::detail
