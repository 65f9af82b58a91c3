// SPDX-License-Identifier: Apache-2.0
#include "bake/placement/probe_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bake/placement/candidates.h"
#include "bake/placement/canonical_scene.h"
#include "bake/placement/grid_bounds.h"
#include "bake/placement/group_by_region.h"
#include "bake/placement/lattice.h"
#include "bake/placement/reach.h"
#include "bake/placement/space_map.h"
#include "base/text.h"

namespace tetralight {
namespace {

/// Moves stay below half of the way to the next candidate.
constexpr double kReachShare = 0.45;
/// Probes on surfaces keep this share of the spacing from each other.
constexpr double kCrowdedShare = 0.5;

Result<std::vector<glm::dvec3>> make_candidates(const TraceScene& traced, PlacementMode mode,
                                                const CandidateRule& rule) {
    switch (mode) {
        case PlacementMode::Regular:
            return lattice_candidates(rule);
        case PlacementMode::Layers:
            return layer_candidates(traced, rule);
        case PlacementMode::Surface:
            return surface_candidates(traced, rule);
    }
    return Error{"unknown mode"};
}

std::vector<glm::dvec3> kept_positions(const std::vector<PlacedProbe>& probes) {
    std::vector<glm::dvec3> positions;
    for (const PlacedProbe& probe : probes) {
        if (is_kept(probe.fate)) positions.push_back(probe.position);
    }
    return positions;
}

/// Drops what stands beside another probe on the same side of a wall.
void drop_crowded(const TraceScene& traced, double distance, std::vector<PlacedProbe>& probes) {
    const std::vector<bool> is_crowded = find_crowded(traced, kept_positions(probes), distance);
    size_t i = 0;
    for (PlacedProbe& probe : probes) {
        if (is_kept(probe.fate) && is_crowded[i++]) probe.fate = Fate::Crowded;
    }
}

std::string none_left(const ProbeGrid& grid) {
    return text("no probe is left of ", grid.candidate_count, ": ", grid.count(Fate::Inside),
                " inside geometry, ", grid.count(Fate::TooClose), " too close to it, ",
                grid.count(Fate::Unreachable), " unreachable, ", grid.count(Fate::Forbidden),
                " forbidden");
}

Result<ProbeGrid> make_groups(const std::vector<PlacedProbe>& probes, Reach reach,
                              const ProbeGridSettings& settings) {
    ProbeGrid grid;
    grid.candidate_count = probes.size();
    std::vector<float> distances;
    for (const PlacedProbe& probe : probes) {
        ++grid.fate_counts[static_cast<size_t>(probe.fate)];
        if (is_kept(probe.fate)) distances.push_back(probe.surface_distance);
    }
    if (distances.empty()) return Error{none_left(grid)};
    RegionGroups regions = group_by_region(kept_positions(probes), reach.spaces,
                                           {settings.group_name, settings.region_size});
    grid.groups = std::move(regions.groups);
    for (const uint32_t i : regions.order) grid.surface_distances.push_back(distances[i]);
    grid.pockets = std::move(reach.pockets);
    return grid;
}

}  // namespace

Result<ProbeGrid> make_probe_grid(const Scene& scene, const ProbeGridSettings& settings) {
    const auto bounds = grid_bounds(scene, settings);
    if (!bounds) return bounds.error();
    const auto clearance = checked_clearance(settings);
    if (!clearance) return clearance.error();
    // Before anything that takes time.
    const CandidateRule rule{*bounds,          settings.spacing,         *clearance,
                             settings.heights, settings.max_probe_count, settings.thread_count};
    if (auto status = make_lattice(rule.bounds, rule.spacing, rule.max_count); !status) {
        return status.error();
    }
    const Scene canonical = canonical_scene(scene);
    const auto traced = TraceScene::make_static(canonical);
    if (!traced) return traced.error();
    const auto candidates = make_candidates(*traced, settings.mode, rule);
    if (!candidates) return candidates.error();

    const double smallest = std::min({rule.spacing.x, rule.spacing.y, rule.spacing.z});
    std::vector<PlacedProbe> probes = place_probes(
        *traced, *candidates, {rule.clearance, kReachShare * smallest}, settings.thread_count);
    if (settings.mode == PlacementMode::Surface) {
        drop_crowded(*traced, kCrowdedShare * smallest, probes);
    }
    const auto reach = drop_unreachable(*traced, *bounds, settings, probes);
    if (!reach) return reach.error();
    return make_groups(probes, std::move(*reach), settings);
}

}  // namespace tetralight
