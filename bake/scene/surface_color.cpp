// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/surface_color.h>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <tetralight/bake/scene/texture.h>

namespace tetralight {
namespace {

/// Reflectivity of dielectrics at normal incidence (glTF 2.0, appendix B: index of refraction 1.5).
constexpr float kDielectricF0 = 0.04f;

const Material& material_of(const Scene& scene, const MeshPoint& point) {
    return scene.materials[point.mesh->material];
}

bool is_textured(const TextureUse& use, const MeshPoint& point) {
    return use.texture != kNoIndex && !point.mesh->uvs[use.uv_set].empty();
}

glm::vec2 image_uv(const TextureUse& use, const MeshPoint& point) {
    return use.image_from_mesh * glm::vec3(point.blend(point.mesh->uvs[use.uv_set]), 1.0f);
}

glm::vec4 sample_color(const Scene& scene, const TextureUse& use, const MeshPoint& point) {
    if (!is_textured(use, point)) return glm::vec4(1.0f);
    return sample_texture(scene.textures[use.texture], image_uv(use, point));
}

/// Factors of roughness (green) and metallic (blue).
glm::vec4 sample_data(const Scene& scene, const TextureUse& use, const MeshPoint& point) {
    if (!is_textured(use, point)) return glm::vec4(1.0f);
    return sample_data_texture(scene.textures[use.texture], image_uv(use, point));
}

}  // namespace

MeshPoint mesh_point(const Mesh& mesh, uint32_t triangle, glm::vec2 barycentric) {
    const uint32_t* corners = &mesh.indices[size_t{triangle} * 3];
    return {&mesh,
            {corners[0], corners[1], corners[2]},
            {1.0f - barycentric.x - barycentric.y, barycentric.x, barycentric.y}};
}

glm::vec3 diffuse_reflectivity(glm::vec3 base_color, float metallic, float roughness) {
    const glm::vec3 specular = glm::mix(glm::vec3(kDielectricF0), base_color, metallic);
    return base_color * ((1.0f - metallic) * (1.0f - kDielectricF0)) +
           specular * (0.5f * roughness);
}

ReflectivityTerms reflectivity_terms(float metallic, float roughness) {
    const float dielectric = 1.0f - metallic, wide = 0.5f * roughness;
    return {dielectric * (1.0f - kDielectricF0) + metallic * wide,
            dielectric * kDielectricF0 * wide};
}

glm::vec3 diffuse_reflectivity(const Scene& scene, const MeshPoint& point) {
    const Material& material = material_of(scene, point);
    if (material.is_unlit) return glm::vec3(0.0f);
    const glm::vec4 factors = sample_data(scene, material.metallic_roughness_texture, point);
    return diffuse_reflectivity(glm::vec3(base_color(scene, point)), material.metallic * factors.b,
                                material.roughness * factors.g);
}

ShinySurface shiny_surface(const Scene& scene, const MeshPoint& point) {
    const Material& material = material_of(scene, point);
    if (material.is_unlit) return {};
    const glm::vec4 factors = sample_data(scene, material.metallic_roughness_texture, point);
    const glm::vec3 color(base_color(scene, point));
    const float metallic = material.metallic * factors.b;
    return {color * ((1.0f - metallic) * (1.0f - kDielectricF0)),
            glm::mix(glm::vec3(kDielectricF0), color, metallic), material.roughness * factors.g};
}

glm::vec3 adjusted_albedo(glm::vec3 albedo, const SurfaceSettings& settings) {
    if (settings.albedo_boost != 1.0f) {
        albedo = glm::pow(albedo, glm::vec3(1.0f / settings.albedo_boost));
    }
    return glm::clamp(albedo, 0.0f, settings.max_albedo);
}

glm::vec4 base_color(const Scene& scene, const MeshPoint& point) {
    const Material& material = material_of(scene, point);
    const glm::vec4 color =
        material.base_color * sample_color(scene, material.base_color_texture, point);
    return point.mesh->colors.empty() ? color : color * point.blend(point.mesh->colors);
}

EmissionSource emission_source(const Material& material) {
    if (material.is_unlit) return {glm::vec3(material.base_color), material.base_color_texture};
    return {material.emission, material.emission_texture};
}

glm::vec3 emitted_radiance(const Scene& scene, const MeshPoint& point) {
    const Material& material = material_of(scene, point);
    if (material.is_unlit) return glm::vec3(base_color(scene, point));
    const EmissionSource source = emission_source(material);
    if (source.factor == glm::vec3(0.0f)) return source.factor;
    return source.factor * glm::vec3(sample_color(scene, source.texture, point));
}

}  // namespace tetralight
