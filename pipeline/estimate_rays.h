// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>

// What a bake will cost, before it begins.

namespace tetralight {

struct RayEstimate {
    double rays = 0.0;  ///< of all places
    /// Of this machine, with the threads of the settings; 0 without places.
    double rays_per_second = 0.0;
};

/// Bakes the first samples of a few places, spread over all of them, and expects of all places the
/// mean of the rays that these need to reach the targets of the settings. `occlusion_lights`: one a
/// place, or empty. Places that have surfaces trace paths to their ends. Returns the errors of
/// `bake_accumulators`.
[[nodiscard]] Result<RayEstimate> estimate_rays(const Scene& scene, const BakePlaces& places,
                                                const BakeSettings& settings,
                                                std::span<const OcclusionLights> occlusion_lights,
                                                const BakeCallback& callback = {});

}  // namespace tetralight
