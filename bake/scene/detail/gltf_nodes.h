// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// A node of the default scene, with the properties that it inherits.
struct GltfWorldNode {
    uint32_t node = 0;
    uint32_t parent = kNoIndex;
    glm::dmat4 world_from_node{1.0};
    /// False: its mesh and its light are left out (KHR_node_visibility).
    bool is_visible = true;
    bool contributes_gi = true;
    bool is_walkable = false;
    bool is_in_reflections = true;
    LightmapUse lightmap{};
    LightProbeUsage light_probes = LightProbeUsage::Blend;
    /// The node whose `extras.probe_anchor` applies (its own or an ancestor), or kNoIndex.
    uint32_t anchored_by = kNoIndex;
};

/// The nodes of `Scene`, in the same order. Returns not_found or invalid_argument if a
/// `probe_anchor` is not the name of exactly one node.
[[nodiscard]] Result<std::vector<SceneNode>> scene_nodes(const GltfDocument& document,
                                                         std::span<const GltfWorldNode> nodes);

/// The default scene's nodes, parents before children and children in the file's order. Returns
/// corrupt if a node has two parents, is part of a cycle, or has a transform that is not finite.
/// Does not recurse, so that any depth works.
[[nodiscard]] Result<std::vector<GltfWorldNode>> flatten_nodes(const GltfDocument& document);

}  // namespace tetralight::detail
