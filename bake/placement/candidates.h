// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include <tetralight/bake/placement/walkable.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/result.h>

// Candidate positions of probes, before they are classified. All functions work in world space and
// return a fixed order that does not depend on the number of threads. Errors: those of
// `make_lattice`.

namespace tetralight {

/// The settings of candidates.
struct CandidateRule {
    WorldBox bounds;
    glm::dvec3 spacing{1.0};
    /// Surfaces: metres from the wall.
    double clearance = 0.0;
    /// Layers: metres above the floor.
    std::vector<double> heights;
    uint64_t max_count = 0;
    uint32_t thread_count = 0;
    /// Layers: the floor, if not null.
    const WalkableSurface* walkable = nullptr;
};

/// A lattice (`make_lattice`).
[[nodiscard]] Result<std::vector<glm::dvec3>> lattice_candidates(const CandidateRule& rule);

/// Positions in columns `spacing` apart, at the heights above every floor in the bounds. A floor is
/// a front face whose normal is less than 60° from up; with a walkable surface, that surface alone
/// is the floor. Skips heights that a surface of the scene separates from the floor (from 5 cm
/// above a walkable surface), and those outside of the bounds. Returns invalid_argument if there is
/// no position.
[[nodiscard]] Result<std::vector<glm::dvec3>> layer_candidates(const TraceScene& traced,
                                                               const CandidateRule& rule);

/// Metres from a world position down to the floor below it: none if the nearest surface below is
/// not one.
[[nodiscard]] std::optional<double> height_above_floor(const TraceScene& traced,
                                                       const glm::dvec3& position);

/// Positions on both sides of every surface in the bounds, at the clearance, about one `spacing`
/// apart: where lines along an axis hit surfaces whose normal is closest to this axis. Skips
/// positions outside of the bounds. Returns invalid_argument if there is no position.
[[nodiscard]] Result<std::vector<glm::dvec3>> surface_candidates(const TraceScene& traced,
                                                                 const CandidateRule& rule);

/// Flags candidates that are closer than `distance` to an earlier candidate without a flag that is
/// visible from them. Precondition: distance > 0.
[[nodiscard]] std::vector<bool> find_crowded(const TraceScene& traced,
                                             std::span<const glm::dvec3> positions,
                                             double distance);

}  // namespace tetralight
