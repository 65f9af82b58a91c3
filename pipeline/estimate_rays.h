// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/place_range.h>

// What a bake will cost, before it begins.

namespace tetralight {

struct RayEstimate {
    /// Rays that each place is expected to take, in the order of the bake.
    std::vector<double> rays;
    /// Of this machine, with the threads of the settings; 0 without places.
    double rays_per_second = 0.0;

    [[nodiscard]] double sum() const;
};

/// Bakes the first samples of a few places, spread over all of them, and expects of each place the
/// rays of the nearest of these in the order of the bake: those that it needs to reach the targets
/// of the settings. `occlusion_lights`: one a place, or empty. Places that have surfaces trace
/// paths to their ends. Returns the errors of `bake_accumulators`.
[[nodiscard]] Result<RayEstimate> estimate_rays(const Scene& scene, const BakePlaces& places,
                                                const BakeSettings& settings,
                                                std::span<const OcclusionLights> occlusion_lights,
                                                const BakeCallback& callback = {});

/// Cuts all places into at most `count` ranges, one after the other, that cost about the same. Each
/// has a place. Without places there is one empty range.
[[nodiscard]] std::vector<PlaceRange> cut_ranges(std::span<const double> costs, size_t count);

}  // namespace tetralight
