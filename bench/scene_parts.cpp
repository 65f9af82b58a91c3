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

void add_mesh(Scene& scene, Mesh mesh, const Material& material) {
    mesh.material = static_cast<uint32_t>(scene.materials.size());
    scene.materials.push_back(material);
    MeshInstance instance;
    instance.mesh = static_cast<uint32_t>(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back(instance);
}

}  // namespace tetralight::bench
