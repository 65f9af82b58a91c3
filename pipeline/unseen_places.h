// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/free_places.h>

namespace tetralight {

/// How much of the free space sees no probe of its cell, so that its light comes through walls
/// with any weights.
struct UnseenPlaces {
    /// Free places that were looked at, and those of them that see no corner of their cell.
    uint64_t place_count = 0;
    uint64_t unseen_count = 0;
    /// Up to eight of the unseen ones, more than one spacing of probes apart (`spread_positions`).
    /// World space, rounded to a millimetre.
    std::vector<glm::dvec3> positions;

    /// The share of free space that is unseen; 0 if no place was looked at.
    [[nodiscard]] double share() const {
        return place_count == 0
                   ? 0.0
                   : static_cast<double>(unseen_count) / static_cast<double>(place_count);
    }

    bool operator==(const UnseenPlaces&) const = default;
};

/// Places that bakes look at: the standard error of a share of 1 % is 0.16 %.
inline constexpr uint32_t kUnseenPlaceCount = 4096;

[[nodiscard]] UnseenPlaces find_unseen(const FreePlaces& found);

/// Measures the unseen share of a volume in a scene. Volumes that know no walls are measured too:
/// it depends on positions and surfaces alone. `min_validity`: as in `HealthSettings`. Returns the
/// errors of `TraceScene::make_static`.
[[nodiscard]] Result<UnseenPlaces> measure_unseen(const Scene& scene, const ProbeVolumeView& volume,
                                                  float min_validity, uint32_t thread_count = 0);

}  // namespace tetralight
