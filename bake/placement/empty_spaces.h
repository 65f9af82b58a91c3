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

/// Free positions in one space.
struct SpacePositions {
    uint32_t space = 0;
    std::vector<glm::dvec3> positions;
    /// Points of the map that the space has in the bounds.
    size_t point_count = 0;
};

/// Which positions to find: PointClass::Free, at the clearance.
struct FreePositionRule {
    WorldBox bounds;
    double clearance = 0.0;
    /// Positions per space.
    size_t max_count = 1;
    uint32_t thread_count = 0;
};

/// The spaces of a map that have no probes (`filled` are those that have some, sorted), with free
/// positions in them. Skips spaces without a free position in the bounds.
[[nodiscard]] std::vector<SpacePositions> find_free_positions(const TraceScene& traced,
                                                              const FreeSpaceMap& map,
                                                              std::span<const uint32_t> filled,
                                                              const FreePositionRule& rule);

/// Moves `count` positions to the front, by farthest-point sampling: each is the one farthest from
/// those before it and from those `taken`.
void sort_farthest_first(std::vector<glm::dvec3>& places, std::span<const glm::dvec3> taken,
                         size_t count);

}  // namespace tetralight
