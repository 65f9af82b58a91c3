// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/shadow_origin.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <tetralight/bake/scene/surface_color.h>

namespace tetralight {

glm::vec3 shadow_origin(const Scene& scene, const TraceScene& traced, const Surface& surface) {
    const glm::vec3 on_triangle = TraceScene::ray_origin(surface, surface.geometric_normal);
    const MeshInstance& instance = scene.instances[surface.instance];
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (mesh.normals.empty()) return on_triangle;
    const MeshPoint point = mesh_point(mesh, surface.primitive, surface.barycentric);
    const glm::dmat3 normals = glm::transpose(glm::inverse(glm::dmat3(instance.world_from_mesh)));
    glm::vec3 rise(0.0f);
    for (int i = 0; i < 3; ++i) {
        const glm::dvec4 corner(mesh.positions[point.corners[i]], 1.0);
        const glm::dvec3 world(instance.world_from_mesh * corner);
        glm::vec3 normal(glm::normalize(normals * glm::dvec3(mesh.normals[point.corners[i]])));
        if (glm::dot(normal, surface.geometric_normal) < 0.0f) normal = -normal;
        // How far the point is below the tangent plane of the corner: 0 where the surface is
        // hollow.
        const glm::vec3 offset = surface.position - traced.render_from_world(world);
        rise -= point.weights[i] * std::min(0.0f, glm::dot(offset, normal)) * normal;
    }
    return on_triangle + rise;
}

}  // namespace tetralight
