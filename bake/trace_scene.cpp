// SPDX-License-Identifier: Apache-2.0
#include "bake/trace_scene.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "bake/sampling.h"
#include "bake/scene/scene_bounds.h"
#include "bake/scene/texture.h"

namespace tetralight {
namespace {

/// A mirrored instance turns its triangles over: glTF then swaps what is front.
std::vector<uint32_t> mirrored(std::vector<uint32_t> indices) {
    for (size_t i = 0; i + 2 < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
    return indices;
}

/// Cofactors of the linear part: they turn normals right under any scale, and keep them on the
/// front side of mirrored instances when the sign of the determinant is taken out.
glm::mat3 normal_from_mesh(const MeshInstance& instance) {
    const glm::dmat3 m(instance.world_from_mesh);
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                               glm::cross(m[0], m[1]));
    double largest = 0.0;
    for (int i = 0; i < 3; ++i) largest = std::max(largest, glm::length(cofactors[i]));
    return largest > 0.0 ? glm::mat3(cofactors / largest) : glm::mat3(0.0f);
}

/// A triangle's corners in its mesh and the weights of a point in it.
struct MeshPoint {
    std::array<uint32_t, 3> corners;
    glm::vec3 weights;

    template <class T>
    [[nodiscard]] T blend(const std::vector<T>& values) const {
        return values[corners[0]] * weights[0] + values[corners[1]] * weights[1] +
               values[corners[2]] * weights[2];
    }
};

MeshPoint mesh_point(const Mesh& mesh, bool is_mirrored, const RayHit& hit) {
    const uint32_t* corners = &mesh.indices[size_t{hit.primitive} * 3];
    const glm::vec2 b =
        is_mirrored ? glm::vec2(hit.barycentric.y, hit.barycentric.x) : hit.barycentric;
    return {{corners[0], corners[1], corners[2]}, {1.0f - b.x - b.y, b.x, b.y}};
}

glm::vec4 sample_use(const Scene& scene, const TextureUse& use, const Mesh& mesh,
                     const MeshPoint& point) {
    const auto& uvs = mesh.uvs[use.uv_set];
    if (use.texture == kNoIndex || uvs.empty()) return glm::vec4(1.0f);
    const glm::vec3 uv = use.image_from_mesh * glm::vec3(point.blend(uvs), 1.0f);
    return sample_texture(scene.textures[use.texture], glm::vec2(uv));
}

glm::vec4 base_color(const Scene& scene, const Mesh& mesh, const MeshPoint& point) {
    const Material& material = scene.materials[mesh.material];
    return material.base_color * sample_use(scene, material.base_color_texture, mesh, point);
}

glm::vec3 shading_normal(const Mesh& mesh, const MeshPoint& point, const glm::mat3& from_mesh,
                         glm::vec3 geometric_normal) {
    if (mesh.normals.empty()) return geometric_normal;
    const glm::vec3 normal = from_mesh * point.blend(mesh.normals);
    const float length = glm::length(normal);
    return length > 0.0f ? normal / length : geometric_normal;
}

/// How much of the base colour light is passed on diffusely: all by dielectrics, and by metals half
/// of what they reflect times their roughness, because a rough reflection is spread widely.
float diffuse_share(const Material& material) {
    return 1.0f - material.metallic * (1.0f - 0.5f * material.roughness);
}

/// A number in [0, 1) that depends on the ray and the triangle only.
float hash_of(const Ray& ray, const RayHit& hit) {
    const uint64_t origin_key = probe_key(hit.geometry, glm::dvec3(ray.origin));
    const uint64_t key = probe_key(origin_key, glm::dvec3(ray.direction));
    return RandomStream(key, hit.primitive).next();
}

}  // namespace

Result<TraceScene> TraceScene::make(const Scene& scene, const Selection& selection) {
    auto state = std::make_unique<State>();
    const Box bounds = scene_bounds(scene, selection).value_or(Box{});
    state->scene = &scene;
    state->origin = bounds.center();
    // A few float steps at the scene's far end: rounding of a hit position never reaches it.
    state->ray_offset = static_cast<float>(glm::length(bounds.size()) * 0x1p-20);

    RayCaster caster({&TraceScene::stops_at, state.get()});
    std::vector<glm::vec3> positions;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const MeshInstance& instance = scene.instances[i];
        if (!selection(instance) || scene.meshes[instance.mesh].indices.empty()) continue;
        const Placed placed = place(scene, i);
        positions.clear();
        for (const glm::vec3& position : placed.mesh->positions) {
            positions.push_back(glm::vec3(world_position(instance, position) - state->origin));
        }
        const auto& indices = placed.mesh->indices;
        const bool is_opaque = placed.material->alpha_mode == AlphaMode::Opaque;
        caster.add_triangles(positions, placed.is_mirrored ? mirrored(indices) : indices,
                             is_opaque ? RayCaster::Filtered::No : RayCaster::Filtered::Yes);
        state->placed.push_back(placed);
    }
    if (auto status = caster.commit(); !status) return status.error();
    return TraceScene(std::move(state), std::move(caster));
}

Result<TraceScene> TraceScene::make_static(const Scene& scene) {
    return make(scene, [](const MeshInstance& instance) { return instance.contributes_gi; });
}

Light TraceScene::traced_from_world(Light light) const {
    light.position = traced_from_world(glm::dvec3(light.position));
    return light;
}

TraceScene::Placed TraceScene::place(const Scene& scene, uint32_t index) {
    const MeshInstance& instance = scene.instances[index];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const bool is_mirrored = glm::determinant(glm::dmat3(instance.world_from_mesh)) < 0.0;
    return {index, &mesh, &scene.materials[mesh.material],
            normal_from_mesh(instance) * (is_mirrored ? -1.0f : 1.0f), is_mirrored};
}

bool TraceScene::stops_at(const void* context, const Ray& ray, const RayHit& hit) {
    const State& state = *static_cast<const State*>(context);
    const Placed& placed = state.placed[hit.geometry];
    const MeshPoint point = mesh_point(*placed.mesh, placed.is_mirrored, hit);
    const float alpha = base_color(*state.scene, *placed.mesh, point).a;
    if (placed.material->alpha_mode == AlphaMode::Mask) {
        return alpha >= placed.material->alpha_cutoff;
    }
    return hash_of(ray, hit) < alpha;
}

std::optional<Surface> TraceScene::cast(const Ray& ray) const {
    const std::optional<RayHit> hit = caster_.cast(ray);
    if (!hit) return std::nullopt;
    const Scene& scene = *state_->scene;
    const Placed& placed = state_->placed[hit->geometry];
    const Mesh& mesh = *placed.mesh;
    const Material& material = *placed.material;
    const MeshPoint point = mesh_point(mesh, placed.is_mirrored, *hit);

    Surface surface;
    surface.position = ray.origin + hit->distance * ray.direction;
    surface.geometric_normal = glm::normalize(hit->normal);
    surface.shading_normal =
        shading_normal(mesh, point, placed.normal_from_mesh, surface.geometric_normal);
    surface.albedo = glm::vec3(base_color(scene, mesh, point)) * diffuse_share(material);
    surface.emission =
        material.emission * glm::vec3(sample_use(scene, material.emission_texture, mesh, point));
    surface.instance = placed.instance;
    if (glm::dot(surface.geometric_normal, ray.direction) > 0.0f) {
        surface.geometric_normal = -surface.geometric_normal;
        surface.shading_normal = -surface.shading_normal;
        surface.is_from_behind = true;
        surface.is_back_face = !material.is_double_sided;
    }
    return surface;
}

}  // namespace tetralight
