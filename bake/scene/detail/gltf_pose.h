// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_meshes.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// Adds meshes for the nodes that morph targets with weights, or a skin, deform: first by the morph
/// targets, then by the skin, which puts them into the world. Nodes with the same mesh, skin and
/// weights share them. Skips nodes that are not visible. Returns corrupt if morph targets, joints
/// or weights do not fit, and unsupported if deformed meshes have more than 2^28 vertices in all.
[[nodiscard]] Status pose_meshes(const GltfDocument& document, std::span<const GltfWorldNode> nodes,
                                 NormalMaps normal_maps, GltfMeshes& meshes);

}  // namespace tetralight::detail
