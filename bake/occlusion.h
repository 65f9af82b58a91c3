// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/texel_surface.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Shadow rays per place and light if the light may be partly visible: it has an area, or the scene
/// has alpha-blended surfaces. Other lights take one ray.
inline constexpr uint32_t kOcclusionRayCount = 256;

/// Fraction of a point, spot or directional light (in render space) that is visible from `origin`:
/// 1 = all of it, 0 for area lights. Includes the light's radius or angle and alpha-blended
/// surfaces. Ignores range and cone, which the direct term of the runtime applies. A pure function.
/// `ray_count`: of lights that may be partly visible, at least 1.
[[nodiscard]] float light_visibility(const PathTracer& tracer, const Light& light, glm::vec3 origin,
                                     uint64_t key, uint32_t ray_count = kOcclusionRayCount);

/// The occlusion of a probe, one channel per element of `channel_lights`: the visibility of that
/// light, an index into `lights` (in render space), or 1 if the channel has no light.
[[nodiscard]] glm::vec4 probe_occlusion(const PathTracer& tracer, std::span<const Light> lights,
                                        const OcclusionLights& channel_lights, glm::vec3 origin,
                                        uint64_t key);

/// The same of a texel: the mean over its places, which share the rays of a probe. `position`: in
/// render space.
[[nodiscard]] glm::vec4 texel_occlusion(const PathTracer& tracer, std::span<const Light> lights,
                                        const OcclusionLights& channel_lights, glm::vec3 position,
                                        const TexelSurface& surface, uint64_t key);

}  // namespace tetralight
