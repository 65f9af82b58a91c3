// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include <tetralight/bake/path_tracer.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Shadow rays to a light that can be seen in part: a soft one, or any in a scene with surfaces
/// that let a part of the rays through.
inline constexpr uint32_t kOcclusionRayCount = 256;

/// Share of a point, spot or directional light (render space) that is visible from `origin`:
/// 1 = all of it. Soft with its radius or angle; what surfaces let through counts. Range and cone
/// have no say: where they end, the direct term does. 0 for area lights. A pure function.
[[nodiscard]] float light_visibility(const PathTracer& tracer, const Light& light, glm::vec3 origin,
                                     uint64_t key);

/// The occlusion of a probe: the visibility of each of `owners`, indices into `lights` (render
/// space); 1 in channels that are nobody's.
[[nodiscard]] glm::vec4 probe_occlusion(const PathTracer& tracer, std::span<const Light> lights,
                                        const OcclusionLights& owners, glm::vec3 origin,
                                        uint64_t key);

}  // namespace tetralight
