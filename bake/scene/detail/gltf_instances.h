// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_meshes.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/bake/scene/detail/part_list.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// Where a mesh of a node stands.
struct GltfPlacement {
    glm::dmat4 world_from_mesh{1.0};
    /// Its index in EXT_mesh_gpu_instancing; 0 without.
    uint32_t transform = 0;
};

/// The number of a node's instances by EXT_mesh_gpu_instancing; 1 without.
[[nodiscard]] uint32_t transform_count(const GltfDocument& document, const GltfNode& node);

/// The placements of a node's mesh whose transforms are invertible: without those that are scaled
/// to 0 along some axis. Returns corrupt if a transform is not finite.
[[nodiscard]] Result<std::vector<GltfPlacement>> mesh_placements(const GltfDocument& document,
                                                                 const GltfWorldNode& placed);

/// One instance for each triangle primitive of each node's mesh, times the instances of the node's
/// EXT_mesh_gpu_instancing. Skips nodes that are probes. Leaves out what is scaled to 0, and adds a
/// row to `parts` that names it. Meshes that a skin deforms are in the
/// world already: one instance each, whatever the node's transforms are. Instances that morph
/// targets or skins deform take their light from probes, since lightmaps are for meshes of the
/// file.
[[nodiscard]] Result<std::vector<MeshInstance>> read_instances(const GltfDocument& document,
                                                               std::span<const GltfWorldNode> nodes,
                                                               const std::vector<bool>& is_probe,
                                                               const GltfMeshes& meshes,
                                                               PartList& parts);

}  // namespace tetralight::detail
