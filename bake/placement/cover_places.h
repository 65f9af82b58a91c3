// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/placement/coverage.h>
#include <tetralight/bake/placement/reach_walls.h>
#include <tetralight/bake/rays/trace_scene.h>

namespace tetralight {

/// What new probes may be.
struct CoverRule {
    /// The clearance, and how far probes may reach.
    ReachRule ends;
    /// How far from an uncovered place its probe may be, metres: outside of the tetrahedra it goes
    /// to walls, edges and corners, so that they grow as far as they can.
    double reach = 1.0;
    /// Returns true if a free position may have a probe; called from many threads.
    std::function<bool(const glm::dvec3& position)> is_allowed;
    /// The maximum number of new probes.
    size_t max_count = 0;
    uint32_t thread_count = 0;
};

/// Finds positions for probes that cover free places (world space) which `probes` leave uncovered.
/// Goes on in rounds until hardly any place is uncovered, the maximum is reached, or nothing helps.
/// In each round, positions that see each other are apart. Deterministic.
[[nodiscard]] std::vector<glm::dvec3> cover_places(const TraceScene& traced,
                                                   std::span<const glm::dvec3> probes,
                                                   std::span<const glm::dvec3> places,
                                                   const CoverRule& rule);

/// The cover of places by probes at these positions. Without tetrahedra, places off the plane, the
/// line or the point of the probes are in hull cells.
[[nodiscard]] std::vector<Cover> cover_by(const TraceScene& traced,
                                          std::span<const glm::dvec3> probes,
                                          std::span<const glm::dvec3> places,
                                          uint32_t thread_count);

}  // namespace tetralight
