// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/surface_color.h>

// Filtered textures for light transport. Rays of a bake stand for a cone of directions, and need
// the mean reflectivity of the texels inside of it; one read of a coarse level gives that mean, and
// coarse levels stay in the cache of the processor.

namespace tetralight {

/// Diffuse reflectivity is affine in the color of a vertex: `rgb` times the color plus `a`, the
/// specular reflection of a rough dielectric, which has no color. Four half floats, of which none
/// is negative or denormal.
using ReflectivityTexel = std::array<uint16_t, 4>;

/// The mean reflectivity of squares of texels of a material's textures.
struct ReflectivityLevel {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<ReflectivityTexel> texels;
};

/// The diffuse reflectivity of a material, filtered at three resolutions: base color, metallic and
/// roughness with their textures, as `diffuse_reflectivity` computes them, averaged after that
/// computation, so that every level has the exact mean up to the rounding of half floats. Where
/// alpha cuts the surface out or blends it, texels count by their opacity, and the color of hidden
/// texels does not bleed into the surface.
///
/// The finest level has half the resolution of the textures, or less, so that no level has more
/// than 2^20 texels (8 MB). Levels end at a quarter of that resolution in each direction: the
/// coarsest texel covers 8 × 8 texels of textures up to 2048 × 2048, so that the parts of an atlas
/// do not blend beyond the margins that they usually have.
struct ReflectivityMap {
    /// The reflectivity everywhere if there are no levels.
    glm::vec4 constant{0.0f};
    /// As in `TextureUse`.
    uint32_t uv_set = 0;
    glm::mat3 image_from_mesh{1.0f};
    TextureWrap wrap_u = TextureWrap::Repeat;
    TextureWrap wrap_v = TextureWrap::Repeat;
    /// Texels of the textures per unit of texture coordinates: square root of the density by area.
    float texels_per_uv = 0.0f;
    /// Side of the finest level's texels, in texels of the textures.
    float finest_texels = 0.0f;
    /// From fine to coarse; each has half the resolution of the one before, rounded up.
    std::vector<ReflectivityLevel> levels;
};

/// True if the material's reflectivity can be filtered: one texture, or two with the same texture
/// coordinates and wrap modes, or none. `has_vertex_colors`: for meshes with colors; settings that
/// are not linear in the color then exclude the material. Unlit materials reflect nothing and have
/// no map.
[[nodiscard]] bool has_reflectivity_map(const Scene& scene, const Material& material,
                                        const SurfaceSettings& settings, bool has_vertex_colors);

/// The map of a material with the settings of a bake applied to each texel. Takes about 12 ns a
/// texel on one thread, less than decoding a PNG. Precondition: `has_reflectivity_map`.
[[nodiscard]] ReflectivityMap make_reflectivity_map(const Scene& scene, const Material& material,
                                                    const SurfaceSettings& settings);

/// Bytes of the levels of a material's map; 0 without textures.
[[nodiscard]] uint64_t reflectivity_map_bytes(const Scene& scene, const Material& material);

/// Bilinear lookup in one level, at a coordinate of the image.
[[nodiscard]] glm::vec4 sample_reflectivity(const ReflectivityMap& map, size_t level, glm::vec2 uv);

/// The reflectivity of a square of side `footprint`, in units of the mesh's texture coordinates,
/// around a coordinate of the mesh: a bilinear lookup in the coarsest level whose texels are not
/// larger. None if all of them are larger: then the textures themselves have to be read.
[[nodiscard]] std::optional<glm::vec4> filtered_reflectivity(const ReflectivityMap& map,
                                                             glm::vec2 mesh_uv, float footprint);

}  // namespace tetralight
