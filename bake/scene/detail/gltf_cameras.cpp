// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_cameras.h>

#include <glm/geometric.hpp>
#include <utility>

#include <tetralight/bake/scene/detail/gltf_transform.h>

namespace tetralight::detail {
namespace {

/// Cameras have no scale: their axes become unit vectors.
glm::dmat4 without_scale(glm::dmat4 matrix) {
    for (int axis = 0; axis < 3; ++axis) {
        const double length = glm::length(matrix[axis]);
        if (length > 0.0) matrix[axis] /= length;
    }
    return matrix;
}

}  // namespace

std::vector<Camera> read_cameras(const GltfDocument& document, std::span<const GltfWorldNode> nodes,
                                 PartList& parts) {
    std::vector<Camera> cameras;
    for (const GltfWorldNode& placed : nodes) {
        const GltfNode& node = document.nodes[placed.node];
        if (node.camera == kNoIndex) continue;
        const GltfCamera& source = document.cameras[node.camera];
        if (!source.fov_y_radians && !source.half_height) continue;
        if (!is_invertible(placed.world_from_node)) {
            parts.add_left_out("cameras scaled to 0", "look nowhere; left out", false,
                               gltf_place("node", placed.node, node.name));
            continue;
        }
        Camera camera;
        camera.name = node.name.empty() ? source.name : node.name;
        camera.world_from_camera = without_scale(placed.world_from_node);
        camera.fov_y_radians = source.fov_y_radians.value_or(camera.fov_y_radians);
        camera.half_height = source.half_height;
        cameras.push_back(std::move(camera));
    }
    return cameras;
}

}  // namespace tetralight::detail
