// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// True if a skin deforms the node's mesh. False for a skin whose mesh has neither joints nor
/// weights: such a mesh stands where its node is.
[[nodiscard]] bool is_skinned(const GltfDocument& document, const GltfNode& node);

/// For each joint of a skin, the transform of vertices that follow it alone: world_from_joint ·
/// joint_from_mesh. Returns corrupt if a joint is not in the scene, or matrices are missing.
[[nodiscard]] Result<std::vector<glm::dmat4>> skin_matrices(const GltfDocument& document,
                                                            uint32_t skin,
                                                            std::span<const GltfWorldNode> nodes);

/// Moves the vertices of a primitive into the world by the joints of JOINTS_0 and JOINTS_1, with
/// their weights divided by their sum. A vertex whose weights are all 0 follows its first joint.
/// Normals and tangents keep the surface's directions. If most vertices are mirrored, the corners
/// of triangles change their order, so that their front stays the front.
[[nodiscard]] Status apply_skin(const GltfDocument& document, const GltfPrimitive& primitive,
                                std::span<const glm::dmat4> matrices, Mesh& mesh);

}  // namespace tetralight::detail
