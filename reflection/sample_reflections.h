// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/reflection/reflections.h>

// Light that shiny surfaces reflect, from reflection probes. All functions are thread-safe, do not
// allocate (but for reflection_order) and test each index where they use it. GPU twin:
// runtime/shaders/reflection.glsl.

namespace tetralight {

/// The probes that light a position, and their weights, which sum to 1; both are 0 if there is no
/// probe.
struct ReflectionBlend {
    static constexpr uint32_t kMaxProbes = 3;

    std::array<uint32_t, kMaxProbes> probes{};
    std::array<float, kMaxProbes> weights{};
};

/// How much a probe counts at a position, in [0, 1]: 1 in its box, 0 farther outside than the blend
/// distance, a smooth step between. Continuous if the blend distance is above 0. Walls on the sides
/// of the box are in it, however their positions are rounded: it is taken larger by a thousandth.
[[nodiscard]] float reflection_influence(const ReflectionProbe& probe,
                                         const glm::dvec3& position) noexcept;

/// The three most important probes at a position. Probes of higher importance come first, and of
/// smaller boxes among equals; each takes as much of what the earlier ones left as its influence.
/// What all of them leave belongs to the probes that are everywhere (the sky), or if there are
/// none, to the probes by their weights; beyond all boxes to the nearest box.
///
/// With blend distances the weights are continuous in the position, because they are reduced by the
/// fourth largest. They are not where the four largest are equal (no choice of three is), and
/// without a sky where the influence of the last box ends. Cost: O(n).
[[nodiscard]] ReflectionBlend blend_reflections(const ReflectionsView& reflections,
                                                const glm::dvec3& position) noexcept;

/// All probes in the order in which they cover each other, for shaders that blend at each pixel
/// (tetralight_add_reflection in runtime/shaders/reflection.glsl).
[[nodiscard]] std::vector<uint32_t> reflection_order(const ReflectionsView& reflections);

/// The direction from a probe to where a ray from `position` hits the side of its box (Lagarde &
/// Zanuttini 2012, "Local Image-based Lighting With Parallax-corrected Cubemaps"). Outside the box
/// it is mixed, by the influence, from that of the nearest place in the box and the direction
/// itself; without a box it is the direction. Unit vector.
[[nodiscard]] glm::vec3 project_on_box(const ReflectionProbe& probe, const glm::dvec3& position,
                                       glm::vec3 direction) noexcept;

/// Radiance of one cube from a direction (any length), for a roughness in [0, 1]: bilinear across
/// the edges of faces, linear between levels.
[[nodiscard]] glm::vec3 sample_cube(const ReflectionsView& reflections, uint32_t probe,
                                    glm::vec3 direction, float roughness) noexcept;

/// The radiance that a surface of a roughness sees in a direction: the view mirrored at its normal.
[[nodiscard]] glm::vec3 sample_reflections(const ReflectionsView& reflections,
                                           const ReflectionBlend& blend, const glm::dvec3& position,
                                           glm::vec3 direction, float roughness) noexcept;

/// The same without boxes: as if the light of the cubes came from far away.
[[nodiscard]] glm::vec3 sample_far_reflections(const ReflectionsView& reflections,
                                               const ReflectionBlend& blend, glm::vec3 direction,
                                               float roughness) noexcept;

/// Irradiance of the blended cubes, on a unit normal.
[[nodiscard]] glm::vec3 reflection_irradiance(const ReflectionsView& reflections,
                                              const ReflectionBlend& blend,
                                              glm::vec3 normal) noexcept;

/// What reflections are multiplied with, so that dark corners do not shine: the luminance of the
/// irradiance at the place over that at the probe, both on the surface's normal, in [0, 1]. Rough
/// surfaces see much of what lights them; a mirror sees one point of it, which the cube has. So the
/// result is 1 below roughness 0.1 and this ratio above 0.5, with a smooth step between.
[[nodiscard]] float reflection_occlusion(glm::vec3 irradiance, glm::vec3 probe_irradiance,
                                         float roughness) noexcept;

}  // namespace tetralight
