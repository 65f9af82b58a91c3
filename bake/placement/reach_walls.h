// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {

/// How probes reach out to walls.
struct ReachRule {
    WorldBox bounds;
    /// Distance of probes from surfaces, metres.
    double clearance = 0.0;
    /// Axes along which they do.
    glm::bvec3 axes{true};
    /// Returns true where probes may be, if more than surfaces and the bounds decides; its border
    /// counts as a side of the bounds. Empty: everywhere.
    std::function<bool(const glm::dvec3& position)> holds;
};

/// The positions that stand for one free position of a lattice, so that the last layer is at the
/// walls: the tetrahedra then fill the room. Along each axis in turn (up first) a wall, or a side
/// of the bounds, that is nearer than half a spacing takes the position to it; one between half a
/// spacing and a whole one gets a position of its own beside it. So a corner of a room gets one
/// position, and the gaps of the lattice stay below one and a half spacings. Positions are at the
/// clearance from surfaces, and on the sides of the bounds. Pure.
[[nodiscard]] std::vector<glm::dvec3> reach_walls(const TraceScene& traced,
                                                  const glm::dvec3& position,
                                                  const glm::dvec3& spacing, const ReachRule& rule);

/// Moves coordinates that differ by less than `tolerance` to the most frequent of them, axis by
/// axis, so that probes along one wall are exactly coplanar: rounding would make flat tetrahedra of
/// them. Precondition: tolerance > 0.
void align_planes(std::vector<glm::dvec3>& positions, double tolerance);

}  // namespace tetralight
