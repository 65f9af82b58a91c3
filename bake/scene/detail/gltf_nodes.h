// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// A node of the default scene with what it inherits.
struct GltfWorldNode {
    uint32_t node = 0;
    uint32_t parent = kNoIndex;
    glm::dmat4 world_from_node{1.0};
    bool contributes_gi = true;
    LightProbeUsage light_probes = LightProbeUsage::Blend;
    /// The node of the file that names its anchor, or kNoIndex.
    uint32_t anchored_by = kNoIndex;
};

/// The same for users of the scene, in the same order. Error: an anchor that is not the name of
/// exactly one node.
[[nodiscard]] Result<std::vector<SceneNode>> scene_nodes(const GltfDocument& document,
                                                         std::span<const GltfWorldNode> nodes);

/// The default scene's nodes, parents before children and children in the file's order. A node with
/// two parents, a cycle and a transform that is not finite are errors. Walks without recursion, so
/// that depth is no limit.
[[nodiscard]] Result<std::vector<GltfWorldNode>> flatten_nodes(const GltfDocument& document);

}  // namespace tetralight::detail
