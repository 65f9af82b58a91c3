// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_meshes.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// One instance for each triangle primitive of each node's mesh, times the instances of the node's
/// EXT_mesh_gpu_instancing. Skips nodes that are probes. Meshes that a skin deforms are in the
/// world already: one instance each, whatever the node's transforms are. Instances that morph
/// targets or skins deform take their light from probes, since lightmaps are for meshes of the
/// file.
[[nodiscard]] Result<std::vector<MeshInstance>> read_instances(const GltfDocument& document,
                                                               std::span<const GltfWorldNode> nodes,
                                                               const std::vector<bool>& is_probe,
                                                               const GltfMeshes& meshes);

}  // namespace tetralight::detail
