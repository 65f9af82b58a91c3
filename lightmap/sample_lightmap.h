// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include <tetralight/lightmap/lightmaps.h>

// Irradiance from lightmaps, in the units of the lights, not divided by π: a diffuse surface of
// this albedo has the radiance albedo · E / π. Samples are bilinear and clamped to the page. All
// functions are thread-safe, do not allocate and test each index where they use it: pages that are
// out of range are black, also those of corrupt files. GPU twin: runtime/shaders/lightmap.glsl.

namespace tetralight {

/// Where an unwrapped UV (TEXCOORD_1) of an instance's mesh lies in its page.
[[nodiscard]] glm::vec2 page_uv(const LightmapRectangle& rectangle, glm::vec2 uv) noexcept;

/// Irradiance on the normals that the lightmaps were baked for.
[[nodiscard]] glm::vec3 sample_irradiance(const LightmapsView& lightmaps, uint32_t page,
                                          glm::vec2 uv_page) noexcept;

/// The normals of a place, unit, in world space.
struct MappedNormals {
    glm::vec3 base{0.0f};    ///< of the surface: the interpolated normal of its vertices
    glm::vec3 mapped{0.0f};  ///< with the normal map
};

/// Irradiance on the mapped normal: `directional_irradiance` (lightmap/directional_light.h) of the
/// interpolated flux and vector of each channel. On the base normal it is that of
/// `sample_irradiance`, but for rounding. Without section "light" it is so on each normal.
[[nodiscard]] glm::vec3 sample_lightmap(const LightmapsView& lightmaps, uint32_t page,
                                        glm::vec2 uv_page, const MappedNormals& normals) noexcept;

/// How much of the light of each channel the texels see, in [0, 1] (`ShadowMaskTexel`): a mixed
/// light adds its direct term times this, times the shadows of moving objects. 1 without section
/// "shadow_mask".
[[nodiscard]] glm::vec4 sample_shadow_mask(const LightmapsView& lightmaps, uint32_t page,
                                           glm::vec2 uv_page) noexcept;

/// How open the surroundings are, in [0, 1]. 1 without section "ambient_occlusion".
[[nodiscard]] float sample_ambient_occlusion(const LightmapsView& lightmaps, uint32_t page,
                                             glm::vec2 uv_page) noexcept;

/// Many samples: irradiance[i] is that of uvs_page[i] on pages[i], the same bits as those of one
/// sample. Cost: reading four texels each, which is fetched ahead.
/// Precondition: the spans have the same size.
void sample_irradiance(const LightmapsView& lightmaps, std::span<const uint32_t> pages,
                       std::span<const glm::vec2> uvs_page,
                       std::span<glm::vec3> irradiance) noexcept;

}  // namespace tetralight
