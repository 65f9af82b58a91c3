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

/// A candidate of the scene's rule, or of an adjustment volume.
struct Candidate {
    glm::dvec3 position{0.0};
    /// It may move this far to be kept, metres.
    double max_push = 0.0;
    /// An adjustment volume asks for it.
    bool is_adjusted = false;
};

/// The part of the bounds that a volume reaches into; none where it lies outside.
[[nodiscard]] std::optional<WorldBox> bounds_in(const WorldBox& bounds,
                                                const ProbeAdjustment& adjustment);

/// Candidates of the mode by the rule where no volume sets a spacing, and by the volume's own
/// spacing where one does. Errors as in candidates.h.
[[nodiscard]] Result<std::vector<Candidate>> adjusted_candidates(
    const TraceScene& traced, std::span<const ProbeAdjustment> adjustments, PlacementMode mode,
    const CandidateRule& rule);

/// `place_probe` for each, but where a volume forbids probes.
[[nodiscard]] std::vector<PlacedProbe> place_candidates(
    const TraceScene& traced, std::span<const ProbeAdjustment> adjustments,
    std::span<const Candidate> candidates, const CandidateRule& rule);

}  // namespace tetralight
