// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/texel_surface.h>

namespace tetralight {

/// Rays of a texel's ambient occlusion.
inline constexpr uint32_t kAmbientOcclusionRayCount = 256;

/// How open the surroundings of a texel are: the fraction of its hemisphere, weighted by the cosine
/// to its normal, in which no surface is nearer than `distance`, metres. 1 = open, 0 = enclosed.
/// Surfaces block by their alpha, from both sides. The mean over the places of the texel.
/// `position`: in render space. A pure function.
[[nodiscard]] float ambient_occlusion(const TraceScene& scene, glm::vec3 position,
                                      const TexelSurface& surface, float distance, uint64_t key);

}  // namespace tetralight
