// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/adjusted_candidates.h>

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/candidate_count.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// Pushes are shorter than half the distance to the next candidate.
constexpr double kMaxPushFraction = 0.45;

Result<std::vector<glm::dvec3>> make_candidates(const TraceScene& traced, PlacementMode mode,
                                                const CandidateRule& rule) {
    switch (mode) {
        case PlacementMode::Regular:
        case PlacementMode::Adaptive:
            return lattice_candidates(rule);
        case PlacementMode::Layers:
            return layer_candidates(traced, rule);
        case PlacementMode::Surface:
            return surface_candidates(traced, rule);
    }
    return Error{ErrorCode::InvalidArgument, "mode", "", "unknown mode"};
}

/// Adds the candidates of a rule for which `owner` sets the spacing; null: no volume does.
Status add(const TraceScene& traced, std::span<const ProbeAdjustment> adjustments,
           PlacementMode mode, const CandidateRule& rule, const ProbeAdjustment* owner,
           std::vector<Candidate>& candidates) {
    const auto positions = make_candidates(traced, mode, rule);
    if (!positions) return positions.error();
    candidates.reserve(candidates.size() + positions->size());
    for (const glm::dvec3& position : *positions) {
        if (adjustment_at(adjustments, position).spacing != owner) continue;
        candidates.push_back({position, rule.spacing, owner != nullptr});
    }
    return check_candidate_count(static_cast<double>(candidates.size()), rule.max_count);
}

}  // namespace

std::optional<WorldBox> bounds_in(const WorldBox& bounds, const ProbeAdjustment& adjustment) {
    const double half = adjustment.shape == AdjustmentShape::Sphere ? 1.0 : 0.5;
    WorldBox box = WorldBox::empty();
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 local(corner & 1 ? half : -half, corner & 2 ? half : -half,
                               corner & 4 ? half : -half, 1.0);
        const glm::dvec3 world(adjustment.world_from_volume * local);
        box = union_of(box, world);
    }
    box = intersection_of(box, bounds);
    if (glm::any(glm::greaterThan(box.min, box.max))) return std::nullopt;
    return box;
}

Result<std::vector<Candidate>> adjusted_candidates(const TraceScene& traced,
                                                   std::span<const ProbeAdjustment> adjustments,
                                                   PlacementMode mode, const CandidateRule& rule) {
    std::vector<Candidate> candidates;
    auto status = add(traced, adjustments, mode, rule, nullptr, candidates);
    if (!status) return status.error();
    for (const ProbeAdjustment& adjustment : adjustments) {
        const auto box = bounds_in(rule.bounds, adjustment);
        if (!adjustment.spacing || !box) continue;
        CandidateRule dense = rule;
        dense.bounds = *box;
        dense.spacing = glm::dvec3(*adjustment.spacing);
        status = add(traced, adjustments, mode, dense, &adjustment, candidates);
        if (!status) {
            return status.error().in(str_cat("adjustment volume \"", adjustment.name, "\""));
        }
    }
    return candidates;
}

std::vector<PlacedProbe> place_candidates(const TraceScene& traced,
                                          std::span<const ProbeAdjustment> adjustments,
                                          std::span<const Candidate> candidates,
                                          const CandidateRule& rule) {
    std::vector<PlacedProbe> placed(candidates.size());
    parallel_for(candidates.size(), rule.thread_count, [&](size_t i) {
        const auto& [position, spacing, is_adjusted] = candidates[i];
        const double max_push = kMaxPushFraction * std::min({spacing.x, spacing.y, spacing.z});
        placed[i] = {position, Fate::Forbidden, 0.0f};
        if (adjustment_at(adjustments, position).forbids_probes) return;
        placed[i] = place_probe(traced, position, {rule.clearance, max_push, rule.bounds});
        // A push must not end in a volume that forbids probes.
        if (adjustment_at(adjustments, placed[i].position).forbids_probes) {
            placed[i].fate = Fate::Forbidden;
        }
    });
    return placed;
}

}  // namespace tetralight
