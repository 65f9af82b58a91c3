// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include <tetralight/bake/placement/candidates.h>
#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/probe_adjustment.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// A candidate from the grid's spacing, or from an adjustment volume.
struct Candidate {
    glm::dvec3 position{0.0};
    /// Metres to the next candidate along each axis.
    glm::dvec3 spacing{1.0};
    /// True if it comes from the spacing of an adjustment volume.
    bool is_adjusted = false;
};

/// The intersection of the bounds with the bounds of a volume; empty if it is outside.
[[nodiscard]] std::optional<WorldBox> bounds_in(const WorldBox& bounds,
                                                const ProbeAdjustment& adjustment);

/// Candidates of the mode: with the spacing of the smallest volume around them that sets one, else
/// with that of the rule. Errors as in candidates.h.
[[nodiscard]] Result<std::vector<Candidate>> adjusted_candidates(
    const TraceScene& traced, std::span<const ProbeAdjustment> adjustments, PlacementMode mode,
    const CandidateRule& rule);

/// `place_probe` for each candidate, with pushes of less than half its spacing; Fate::Forbidden
/// where a volume forbids probes.
[[nodiscard]] std::vector<PlacedProbe> place_candidates(
    const TraceScene& traced, std::span<const ProbeAdjustment> adjustments,
    std::span<const Candidate> candidates, const CandidateRule& rule);

}  // namespace tetralight
