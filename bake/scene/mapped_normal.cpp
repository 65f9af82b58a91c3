// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/mapped_normal.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include <tetralight/bake/scene/texture.h>

namespace tetralight {
namespace {

/// The axes of tangent space in world space.
struct TangentAxes {
    glm::vec3 along{0.0f};   ///< x
    glm::vec3 across{0.0f};  ///< y
};

const Material& material_of(const Scene& scene, const Mesh& mesh) {
    return scene.materials[mesh.material];
}

bool is_direction(const glm::vec3& vector) {
    const float square = glm::dot(vector, vector);
    return square > 0.0f && std::isfinite(square);
}

/// True if the image lies in the mesh as its texture coordinates do, but for position and size.
bool keeps_directions(const glm::mat3& image_from_mesh) {
    return image_from_mesh[0][1] == 0.0f && image_from_mesh[1][0] == 0.0f &&
           image_from_mesh[0][0] > 0.0f && image_from_mesh[1][1] > 0.0f;
}

TangentAxes axes_of_tangents(const MeshPoint& point, const glm::mat3& world_from_mesh,
                             const glm::vec3& base_normal) {
    const glm::vec4 tangent = point.blend(point.mesh->tangents);
    const glm::vec3 along = world_from_mesh * glm::vec3(tangent);
    const bool is_mirrored = (glm::determinant(world_from_mesh) < 0.0f) != (tangent.w < 0.0f);
    return {along, glm::cross(base_normal, along) * (is_mirrored ? -1.0f : 1.0f)};
}

/// The derivatives of the position by the UVs of the image, times |the area of the UVs|.
TangentAxes axes_of_uvs(const TextureUse& use, const MeshPoint& point,
                        const glm::mat3& world_from_mesh) {
    glm::vec3 corners[3];
    glm::vec2 uvs[3];
    for (size_t i = 0; i < 3; ++i) {
        corners[i] = point.mesh->positions[point.corners[i]];
        uvs[i] =
            use.image_from_mesh * glm::vec3(point.mesh->uvs[use.uv_set][point.corners[i]], 1.0f);
    }
    const glm::vec3 first = world_from_mesh * (corners[1] - corners[0]);
    const glm::vec3 second = world_from_mesh * (corners[2] - corners[0]);
    const glm::vec2 s = uvs[1] - uvs[0], t = uvs[2] - uvs[0];
    const float area = s.x * t.y - s.y * t.x;
    if (area == 0.0f) return {};
    const float sign = area < 0.0f ? -1.0f : 1.0f;
    return {sign * (t.y * first - s.y * second), sign * (t.x * first - s.x * second)};
}

/// Perpendicular to the base normal and to each other, of length 1; empty if they are degenerate.
std::optional<TangentAxes> tangent_axes(const Scene& scene, const MeshPoint& point,
                                        const glm::mat3& world_from_mesh,
                                        const glm::vec3& base_normal) {
    const TextureUse& use = material_of(scene, *point.mesh).normal_texture;
    TangentAxes axes = uses_tangents(scene, *point.mesh)
                           ? axes_of_tangents(point, world_from_mesh, base_normal)
                           : axes_of_uvs(use, point, world_from_mesh);
    axes.along -= glm::dot(axes.along, base_normal) * base_normal;
    if (!is_direction(axes.along) || !is_direction(axes.across)) return std::nullopt;
    axes.along = glm::normalize(axes.along);
    const glm::vec3 across = glm::cross(base_normal, axes.along);
    axes.across = glm::dot(across, axes.across) < 0.0f ? -across : across;
    return axes;
}

/// The vector of the normal map in tangent space, not normalized.
glm::vec3 sampled_normal(const Scene& scene, const MeshPoint& point) {
    const Material& material = material_of(scene, *point.mesh);
    const TextureUse& use = material.normal_texture;
    const glm::vec2 uv =
        use.image_from_mesh * glm::vec3(point.blend(point.mesh->uvs[use.uv_set]), 1.0f);
    const glm::vec4 texel = sample_data_texture(scene.normal_maps[use.texture], uv);
    const glm::vec2 xy = 2.0f * glm::vec2(texel) - 1.0f;
    const float z = std::sqrt(std::max(0.0f, 1.0f - glm::dot(xy, xy)));
    return {material.normal_scale * xy, z};
}

}  // namespace

bool has_normal_map(const Scene& scene, const Mesh& mesh) {
    const TextureUse& use = material_of(scene, mesh).normal_texture;
    return use.texture != kNoIndex && !mesh.uvs[use.uv_set].empty();
}

bool lacks_normal_map_uvs(const Scene& scene, const Mesh& mesh) {
    const TextureUse& use = material_of(scene, mesh).normal_texture;
    return use.texture != kNoIndex && mesh.uvs[use.uv_set].empty();
}

bool uses_tangents(const Scene& scene, const Mesh& mesh) {
    return !mesh.tangents.empty() &&
           keeps_directions(material_of(scene, mesh).normal_texture.image_from_mesh);
}

glm::vec3 mapped_normal(const Scene& scene, const MeshPoint& point,
                        const glm::mat3& world_from_mesh, const glm::vec3& base_normal) {
    if (!has_normal_map(scene, *point.mesh)) return base_normal;
    const auto axes = tangent_axes(scene, point, world_from_mesh, base_normal);
    if (!axes) return base_normal;
    const glm::vec3 n = sampled_normal(scene, point);
    const glm::vec3 normal = n.x * axes->along + n.y * axes->across + n.z * base_normal;
    return is_direction(normal) ? glm::normalize(normal) : base_normal;
}

}  // namespace tetralight
