// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <tetralight/bake/scene/scene.h>

// Properties of a material at one point, for light transport: diffuse reflectivity, emission,
// alpha.

namespace tetralight {

/// How a bake changes the reflectivity of surfaces.
struct SurfaceSettings {
    /// 1 to 10: the albedo becomes albedo^(1 / boost); black and white do not change. 1 = no boost.
    float albedo_boost = 1.0f;
    /// Maximum albedo, 0 to 1.
    float max_albedo = 1.0f;

    bool operator==(const SurfaceSettings&) const = default;
};

/// A point of a mesh: the corners of its triangle and their weights, which sum to 1.
struct MeshPoint {
    const Mesh* mesh = nullptr;
    std::array<uint32_t, 3> corners{};
    glm::vec3 weights{0.0f};

    template <class T>
    [[nodiscard]] T blend(const std::vector<T>& values) const {
        return values[corners[0]] * weights[0] + values[corners[1]] * weights[1] +
               values[corners[2]] * weights[2];
    }
};

/// `barycentric` are the weights of the triangle's second and third corner.
[[nodiscard]] MeshPoint mesh_point(const Mesh& mesh, uint32_t triangle, glm::vec2 barycentric);

/// Fraction of light that a material of glTF's metallic-roughness model reflects diffusely:
///
///     base (1 − metallic) (1 − 0.04) + F0 · roughness / 2,    F0 = mix(0.04, base, metallic)
///
/// Dielectrics reflect 4 % specularly, metals all. Half of the specular reflection, times the
/// roughness, is so wide that it counts as diffuse: rough metals bounce light. `roughness` is
/// glTF's, not its square. Never above 0.98 for colours up to 1.
[[nodiscard]] glm::vec3 diffuse_reflectivity(glm::vec3 base_color, float metallic, float roughness);

/// The same at a point, with textures; 0 if the material is unlit.
[[nodiscard]] glm::vec3 diffuse_reflectivity(const Scene& scene, const MeshPoint& point);

/// How a surface reflects in pictures with reflections (glTF 2.0, appendix B): diffusely, and as a
/// GGX surface of this reflectance at normal incidence.
struct ShinySurface {
    glm::vec3 diffuse{0.0f};
    glm::vec3 f0{0.0f};
    float roughness = 1.0f;
};

/// At a point, with textures; black if the material is unlit.
[[nodiscard]] ShinySurface shiny_surface(const Scene& scene, const MeshPoint& point);

/// `diffuse_reflectivity` as a function of the base color: `per_color` · base + `colorless`.
struct ReflectivityTerms {
    float per_color = 0.0f;
    float colorless = 0.0f;
};

[[nodiscard]] ReflectivityTerms reflectivity_terms(float metallic, float roughness);

/// An albedo with the settings of a bake applied: first the boost, then the maximum.
[[nodiscard]] glm::vec3 adjusted_albedo(glm::vec3 albedo, const SurfaceSettings& settings);

/// Base colour and alpha at a point: factor times texture times the colour of the vertices.
[[nodiscard]] glm::vec4 base_color(const Scene& scene, const MeshPoint& point);

/// The emission of a material: radiance, times the texture's colour if there is one, and for unlit
/// materials times the colour of the vertices.
struct EmissionSource {
    glm::vec3 factor{0.0f};
    TextureUse texture;
};

/// Unlit materials emit their base colour, others their emission. Does not read `bakes_emission`.
[[nodiscard]] EmissionSource emission_source(const Material& material);

/// Radiance that the front face of a surface emits at a point.
[[nodiscard]] glm::vec3 emitted_radiance(const Scene& scene, const MeshPoint& point);

}  // namespace tetralight
