// SPDX-License-Identifier: Apache-2.0
#include "bake/placement/probe_grid.h"

#include <algorithm>
#include <utility>

#include "bake/placement/adjusted_candidates.h"
#include "bake/placement/candidates.h"
#include "bake/placement/canonical_scene.h"
#include "bake/placement/grid_bounds.h"
#include "bake/placement/group_by_region.h"
#include "bake/placement/reach.h"
#include "bake/placement/space_map.h"
#include "base/text.h"

namespace tetralight {
namespace {

/// Probes on surfaces keep this share of the spacing from each other.
constexpr double kCrowdedShare = 0.5;

std::vector<glm::dvec3> kept_positions(const std::vector<PlacedProbe>& probes) {
    std::vector<glm::dvec3> positions;
    for (const PlacedProbe& probe : probes) {
        if (is_kept(probe.fate)) positions.push_back(probe.position);
    }
    return positions;
}

double smallest(const glm::dvec3& spacing) {
    return std::min({spacing.x, spacing.y, spacing.z});
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

/// The stages of one grid.
class GridMaker {
  public:
    GridMaker(const Scene& scene, const TraceScene& traced, const ProbeGridSettings& settings,
              const CandidateRule& rule)
        : scene_(scene),
          traced_(traced),
          settings_(settings),
          rule_(rule),
          map_(traced, rule.bounds, rule.spacing, rule.thread_count) {}

    Result<ProbeGrid> run(const AdaptiveCallback& callback) {
        if (auto status = place(); !status) return status.error();
        auto reach = drop_unreachable(traced_, map_, settings_, probes_);
        if (!reach) return reach.error();
        grid_.pockets = std::move(reach->pockets);
        if (settings_.mode == PlacementMode::Adaptive && !kept_positions(probes_).empty()) {
            wanted_ = std::move(reach->wanted);
            auto report = adapt(callback);
            if (!report) return report.error();
            grid_.adaptive = *report;
        }
        return make_groups();
    }

  private:
    Status place() {
        auto candidates =
            adjusted_candidates(traced_, scene_.probe_adjustments, settings_.mode, rule_);
        if (!candidates) return candidates.error();
        probes_ = place_candidates(traced_, scene_.probe_adjustments, *candidates, rule_);
        if (settings_.mode == PlacementMode::Surface) {
            drop_crowded(traced_, kCrowdedShare * smallest(rule_.spacing), probes_);
        }
        for (const Candidate& candidate : *candidates) {
            is_protected_.push_back(candidate.is_adjusted);
        }
        return Ok{};
    }

    Result<AdaptiveReport> adapt(const AdaptiveCallback& callback) {
        const AdaptiveInput input{scene_,
                                  traced_,
                                  rule_.bounds,
                                  rule_.clearance,
                                  [this](const glm::dvec3& position) { return is_free(position); },
                                  rule_.max_count,
                                  settings_.thread_count};
        return refine_grid(input, settings_.adaptive, probes_, is_protected_, callback);
    }

    /// Whether the adaptive mode may put a probe there.
    [[nodiscard]] bool is_free(const glm::dvec3& position) const {
        constexpr double kCloser = 0.5;  // sensors in corners, for measuring only
        if (adjustment_at(scene_.probe_adjustments, position).forbids_probes) return false;
        return is_surely_free(traced_, position, kCloser * rule_.clearance) &&
               std::ranges::binary_search(wanted_, map_.space_of(position));
    }

    Result<ProbeGrid> make_groups() {
        grid_.candidate_count = probes_.size();
        std::vector<float> distances;
        for (const PlacedProbe& probe : probes_) {
            ++grid_.fate_counts[static_cast<size_t>(probe.fate)];
            if (is_kept(probe.fate)) distances.push_back(probe.surface_distance);
        }
        if (distances.empty()) return Error{none_left(grid_)};
        const std::vector<glm::dvec3> positions = kept_positions(probes_);
        RegionGroups regions =
            group_by_region(positions, map_.spaces_of(positions, settings_.thread_count),
                            {settings_.group_name, settings_.region_size});
        grid_.groups = std::move(regions.groups);
        for (const uint32_t i : regions.order) grid_.surface_distances.push_back(distances[i]);
        return std::move(grid_);
    }

    const Scene& scene_;
    const TraceScene& traced_;
    const ProbeGridSettings& settings_;
    const CandidateRule& rule_;
    SpaceMap map_;
    std::vector<PlacedProbe> probes_;
    std::vector<bool> is_protected_;  ///< one a candidate
    std::vector<uint32_t> wanted_;
    ProbeGrid grid_;
};

}  // namespace

Result<ProbeGrid> make_probe_grid(const Scene& scene, const ProbeGridSettings& settings,
                                  const AdaptiveCallback& callback) {
    const auto bounds = grid_bounds(scene, settings);
    if (!bounds) return bounds.error();
    const auto spacing = first_spacing(*bounds, settings);
    if (!spacing) return spacing.error();
    const auto clearance = checked_clearance(*spacing, settings);
    if (!clearance) return clearance.error();
    for (const ProbeAdjustment& adjustment : scene.probe_adjustments) {
        if (auto status = check(adjustment); !status) return status.error();
    }
    const CandidateRule rule{*bounds,
                             *spacing,
                             *clearance,
                             settings.heights,
                             most_probes(settings),
                             settings.thread_count};
    const Scene canonical = canonical_scene(scene);
    const auto traced = TraceScene::make_static(canonical);
    if (!traced) return traced.error();
    return GridMaker(canonical, *traced, settings, rule).run(callback);
}

}  // namespace tetralight
