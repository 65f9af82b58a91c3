// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/result.h>

// Where probes might stand, before anyone looks whether they can. All in world space, in a fixed
// order, and the same for any number of threads. Errors: those of `make_lattice`.

namespace tetralight {

/// What candidates are made from.
struct CandidateRule {
    WorldBox bounds;
    glm::dvec3 spacing{1.0};
    /// Surfaces: metres from the wall.
    double clearance = 0.0;
    /// Layers: metres above the floor.
    std::vector<double> heights;
    uint64_t max_count = 0;
    uint32_t thread_count = 0;
};

/// A lattice (`make_lattice`).
[[nodiscard]] Result<std::vector<glm::dvec3>> lattice_candidates(const CandidateRule& rule);

/// Columns `spacing` apart, and in each the heights above every floor in the bounds: surfaces that
/// face up, by less than 60° off, seen from above, of all storeys. Heights that something stands
/// between and the floor are left out, and so are those above the bounds. Error: nothing is left.
[[nodiscard]] Result<std::vector<glm::dvec3>> layer_candidates(const TraceScene& traced,
                                                               const CandidateRule& rule);

/// Both sides of every surface in the bounds, at the clearance, about one `spacing` apart: where
/// lines along the axes meet surfaces that face more along this axis than along the others. What
/// is not in the bounds is left out.
[[nodiscard]] Result<std::vector<glm::dvec3>> surface_candidates(const TraceScene& traced,
                                                                 const CandidateRule& rule);

/// Flags candidates that stand nearer than `distance` to one before them that is not flagged, and
/// see it. Precondition: distance > 0.
[[nodiscard]] std::vector<bool> find_crowded(const TraceScene& traced,
                                             std::span<const glm::dvec3> positions,
                                             double distance);

}  // namespace tetralight
