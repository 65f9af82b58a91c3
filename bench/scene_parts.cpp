// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/scene_parts.h>

#include <utility>

namespace tetralight::bench {

void append_quad(Mesh& mesh, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : {corner, corner + u, corner + u + v, corner + v}) {
        mesh.positions.push_back(p);
    }
    for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
}

Mesh box_mesh(const WorldBox& box) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.emplace_back(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                                    i & 4 ? box.max.z : box.min.z);
    }
    constexpr uint32_t kQuads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& quad : kQuads) {
        for (const int corner : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(quad[corner]);
    }
    return mesh;
}

void add_mesh(Scene& scene, Mesh mesh, const Material& material) {
    mesh.material = static_cast<uint32_t>(scene.materials.size());
    scene.materials.push_back(material);
    MeshInstance instance;
    instance.mesh = static_cast<uint32_t>(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back(instance);
}

}  // namespace tetralight::bench
