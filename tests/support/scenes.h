// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <utility>

#include <tetralight/bake/scene/scene.h>

// Small scenes whose light has a closed form.

namespace tetralight::test {

/// A material that reflects `albedo` diffusely: polished, so that its base colour alone counts, of
/// which 4 % are mirrored instead.
inline Material diffuse(glm::vec3 albedo, glm::vec3 emission = glm::vec3(0.0f)) {
    Material material;
    material.base_color = glm::vec4(albedo / 0.96f, 1.0f);
    material.metallic = 0.0f;
    material.roughness = 0.0f;
    material.emission = emission;
    return material;
}

/// Adds a mesh of one material, placed as it stands.
inline MeshInstance& add_mesh(Scene& scene, const Material& material, Mesh mesh) {
    mesh.material = static_cast<uint32_t>(scene.materials.size());
    scene.materials.push_back(material);
    scene.meshes.push_back(std::move(mesh));
    MeshInstance instance;
    instance.mesh = static_cast<uint32_t>(scene.meshes.size() - 1);
    scene.instances.push_back(instance);
    return scene.instances.back();
}

/// Appends the parallelogram corner, corner + u, corner + u + v, corner + v; its front is where
/// u × v points to, and its texture coordinates are 0 to 1 along u and v.
inline void append_quad(Mesh& mesh, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::vec2 uv :
         {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        mesh.positions.push_back(corner + uv.x * u + uv.y * v);
        mesh.normals.push_back(glm::normalize(glm::cross(u, v)));
        mesh.uvs[0].push_back(uv);
    }
    for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
}

inline MeshInstance& add_quad(Scene& scene, const Material& material, glm::vec3 corner, glm::vec3 u,
                              glm::vec3 v) {
    Mesh mesh;
    append_quad(mesh, corner, u, v);
    return add_mesh(scene, material, std::move(mesh));
}

/// A square around the Y axis that faces up.
inline MeshInstance& add_floor(Scene& scene, const Material& material, float half_size,
                               float height = 0.0f) {
    return add_quad(scene, material, {-half_size, height, -half_size}, {0, 0, 2 * half_size},
                    {2 * half_size, 0, 0});
}

/// The same, facing down.
inline MeshInstance& add_ceiling(Scene& scene, const Material& material, float half_size,
                                 float height) {
    return add_quad(scene, material, {-half_size, height, -half_size}, {2 * half_size, 0, 0},
                    {0, 0, 2 * half_size});
}

enum class Facing { Inward, Outward };

/// A closed box whose fronts are all inside (a room) or all outside (a solid).
inline MeshInstance& add_box(Scene& scene, const Material& material, Facing facing, glm::vec3 low,
                             glm::vec3 high) {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        glm::vec3 u(0.0f), v(0.0f), top = low;  // u × v points along +axis
        u[next] = high[next] - low[next];
        v[last] = high[last] - low[last];
        top[axis] = high[axis];
        if (facing == Facing::Inward) std::swap(u, v);
        append_quad(mesh, top, u, v);
        append_quad(mesh, low, v, u);
    }
    return add_mesh(scene, material, std::move(mesh));
}

inline Light& add_light(Scene& scene, LightType type, LightMode mode, glm::vec3 intensity) {
    Light light;
    light.type = type;
    light.mode = mode;
    light.intensity = intensity;
    light.direction = {0.0f, -1.0f, 0.0f};
    scene.lights.push_back(light);
    scene.light_names.push_back("light");
    return scene.lights.back();
}

/// Shines straight down.
inline Light& add_sun(Scene& scene, LightMode mode, glm::vec3 irradiance) {
    return add_light(scene, LightType::Directional, mode, irradiance);
}

inline Light& add_point_light(Scene& scene, LightMode mode, glm::vec3 intensity,
                              glm::vec3 position) {
    Light& light = add_light(scene, LightType::Point, mode, intensity);
    light.position = position;
    return light;
}

}  // namespace tetralight::test
