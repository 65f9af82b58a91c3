// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/placement/coverage.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/lppv/lppv_grid.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// A point of a grid that its volume does not cover.
struct UncoveredPoint {
    glm::dvec3 position{0.0};
    Cover cover = Cover::HullCell;

    bool operator==(const UncoveredPoint&) const = default;
};

/// How the probes of a volume light the points of a proxy volume.
struct LppvCoverage {
    /// Counts of the points that are in free space.
    Coverage points;
    /// Up to eight uncovered points where probes would help most: those outside of the tetrahedra
    /// first, at most half of them if others are unseen. Each kind is spread out, farther apart
    /// than the probes are on average (`spread_positions`). World space, rounded to a millimetre.
    std::vector<UncoveredPoint> positions;

    bool operator==(const LppvCoverage&) const = default;
};

/// The static geometry around a grid.
struct LppvSurroundings {
    const TraceScene& traced;
    /// One a grid point: `lppv_grid_validity`.
    std::span<const float> validity;
    /// Points with less are inside geometry, as in `LppvFill::min_validity`.
    float min_validity = 0.5f;
};

/// Uncovered points nearer than this to a surface, metres, do not count: rays that end there may
/// hit the surface by rounding.
inline constexpr float kLppvClearance = 0.01f;

/// Finds which points of a grid are outside of the tetrahedra. Without a scene all points count as
/// free and none as unseen: the walls that a volume knows hide probes by planes fitted to them,
/// which cannot tell that no ray arrives. Volumes of a plane, a line or a point enclose no space,
/// so that no point is outside; points beyond their cells do not count. The same for any number of
/// threads.
[[nodiscard]] LppvCoverage find_lppv_coverage(const ProbeVolumeView& volume, const LppvGrid& grid,
                                              uint32_t thread_count = 0);

/// The same in a scene, where rays tell which points are unseen. Points inside geometry do not
/// count, nor do those outside of the tetrahedra that see too little of their hull cell
/// (`sees_enough`), such as the outside of a closed building. Cost: at most four rays a point, a
/// small part of that of `lppv_grid_validity`.
[[nodiscard]] LppvCoverage find_lppv_coverage(const ProbeVolumeView& volume, const LppvGrid& grid,
                                              const LppvSurroundings& surroundings,
                                              uint32_t thread_count = 0);

}  // namespace tetralight
