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
/// EXT_mesh_gpu_instancing. Skips nodes that are probes.
[[nodiscard]] Result<std::vector<MeshInstance>> read_instances(const GltfDocument& document,
                                                               std::span<const GltfWorldNode> nodes,
                                                               const std::vector<bool>& is_probe,
                                                               const GltfMeshes& meshes);

}  // namespace tetralight::detail
