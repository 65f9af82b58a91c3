// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/placement/free_space_map.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {

/// Places of one space where a probe may stand.
struct SpacePositions {
    uint32_t space = 0;
    std::vector<glm::dvec3> positions;
    /// How many posts of the map the space has in the bounds.
    size_t point_count = 0;
};

/// Where probes may stand, free beyond doubt and at the clearance.
struct FreePositionRule {
    WorldBox bounds;
    double clearance = 0.0;
    /// In each space.
    size_t max_count = 1;
    uint32_t thread_count = 0;
};

/// The spaces of a map, but for those that are `filled` (sorted), and where they have room. Spaces
/// in the bounds without any are left out.
[[nodiscard]] std::vector<SpacePositions> find_free_positions(const TraceScene& traced,
                                                              const FreeSpaceMap& map,
                                                              std::span<const uint32_t> filled,
                                                              const FreePositionRule& rule);

/// Puts the `count` places first that stand farthest from each other and from those `taken`.
void sort_farthest_first(std::vector<glm::dvec3>& places, std::span<const glm::dvec3> taken,
                         size_t count);

}  // namespace tetralight
