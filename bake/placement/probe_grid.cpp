// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/probe_grid.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include <tetralight/bake/placement/adjusted_candidates.h>
#include <tetralight/bake/placement/affine_dimension.h>
#include <tetralight/bake/placement/candidates.h>
#include <tetralight/bake/placement/canonical_scene.h>
#include <tetralight/bake/placement/empty_spaces.h>
#include <tetralight/bake/placement/flood_fill.h>
#include <tetralight/bake/placement/free_space_map.h>
#include <tetralight/bake/placement/grid_bounds.h>
#include <tetralight/bake/placement/group_by_region.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// Minimum distance between probes on surfaces, as a fraction of the spacing.
constexpr double kCrowdedFraction = 0.5;
/// In a space without candidates: start probes, start probes plus sensors, and the free positions
/// that they are chosen from.
constexpr size_t kStartProbes = 8, kStartPlaces = 64, kMaxPlaces = 256;

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

/// Drops probes that are close to another one on the same side of a wall.
void drop_crowded(const TraceScene& traced, double distance, std::vector<PlacedProbe>& probes) {
    const std::vector<bool> is_crowded = find_crowded(traced, kept_positions(probes), distance);
    size_t i = 0;
    for (PlacedProbe& probe : probes) {
        if (is_kept(probe.fate) && is_crowded[i++]) probe.fate = Fate::Crowded;
    }
}

std::string none_left(const ProbeGrid& grid) {
    return str_cat("no probe is left of ", grid.candidate_count, ": ", grid.count(Fate::Inside),
                   " inside geometry, ", grid.count(Fate::TooClose), " too close to it, ",
                   grid.count(Fate::Unreachable), " unreachable, ", grid.count(Fate::Forbidden),
                   " forbidden");
}

/// The heights without those that are closer than the clearance to an earlier one.
std::vector<double> heights_apart(const std::vector<double>& heights, double clearance) {
    std::vector<double> apart;
    for (const double height : heights) {
        const bool is_near = std::ranges::any_of(apart, [&](double other) {
            return height == other || std::abs(height - other) < clearance;
        });
        if (!is_near) apart.push_back(height);
    }
    return apart;
}

/// Positions of the probes in each space.
using ProbesOfSpaces = std::map<uint32_t, std::vector<glm::dvec3>>;

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
        auto fill = drop_unreachable(traced_, map_, settings_, probes_);
        if (!fill) return fill.error();
        grid_.dropped_spaces = std::move(fill->dropped_spaces);
        wanted_ = std::move(fill->wanted);
        fill_empty_spaces(fill->filled);
        if (settings_.mode == PlacementMode::Adaptive && !kept_positions(probes_).empty()) {
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
            drop_crowded(traced_, kCrowdedFraction * smallest(rule_.spacing), probes_);
        }
        for (const ProbeAdjustment& adjustment : scene_.probe_adjustments) {
            const bool is_outside = !bounds_in(rule_.bounds, adjustment);
            if (is_outside) grid_.adjustments_outside.push_back(adjustment.name);
        }
        for (const Candidate& candidate : *candidates) {
            is_protected_.push_back(candidate.is_adjusted);
        }
        return Ok{};
    }

    [[nodiscard]] bool is_wanted(uint32_t space) const {
        const bool keeps_all = settings_.unreachable == UnreachableSpaces::Keep;
        return keeps_all || std::ranges::binary_search(wanted_, space);
    }

    /// Reports spaces without candidates. The adaptive mode adds start probes to those that it is
    /// to fill, and to those whose probes do not enclose a volume.
    void fill_empty_spaces(const std::vector<uint32_t>& filled) {
        constexpr size_t kCubicMetre = 8;  // points
        const bool is_adaptive = settings_.mode == PlacementMode::Adaptive;
        const FreePositionRule rule{rule_.bounds, rule_.clearance, is_adaptive ? kMaxPlaces : 1,
                                    rule_.thread_count};
        ProbesOfSpaces probes;
        if (is_adaptive) probes = probes_by_space();
        const std::vector<uint32_t> done = is_adaptive ? well_filled(filled, probes) : filled;
        std::vector<SpacePositions> spaces = find_free_positions(traced_, map_, done, rule);
        if (wanted_.empty() && !spaces.empty()) {  // the largest, if there is no probe at all
            wanted_ = {std::ranges::max_element(spaces, {}, &SpacePositions::point_count)->space};
        }
        for (SpacePositions& space : spaces) {
            if (is_adaptive && is_wanted(space.space)) {
                start_in(space, probes[space.space]);
                continue;
            }
            const bool is_seeded = !settings_.from.empty() && is_wanted(space.space);
            if (space.point_count < kCubicMetre && !is_seeded) continue;
            grid_.empty_spaces.push_back({space.positions[0], is_wanted(space.space)});
        }
    }

    /// The filled spaces whose probes enclose a volume, and those that are not wanted.
    [[nodiscard]] std::vector<uint32_t> well_filled(const std::vector<uint32_t>& filled,
                                                    ProbesOfSpaces& probes) const {
        std::vector<uint32_t> done;
        for (const uint32_t space : filled) {
            if (!is_wanted(space) || affine_dimension(probes[space]) == 3) done.push_back(space);
        }
        return done;
    }

    [[nodiscard]] ProbesOfSpaces probes_by_space() const {
        const std::vector<glm::dvec3> positions = kept_positions(probes_);
        const std::vector<uint32_t> spaces = map_.spaces_of(positions, rule_.thread_count);
        ProbesOfSpaces result;
        for (size_t i = 0; i < spaces.size(); ++i) result[spaces[i]].push_back(positions[i]);
        return result;
    }

    /// Adds start probes far apart in a space without candidates, and sensors between them, away
    /// from the probes in it.
    void start_in(SpacePositions& space, const std::vector<glm::dvec3>& taken) {
        std::erase_if(space.positions, [&](const glm::dvec3& place) {
            return adjustment_at(scene_.probe_adjustments, place).forbids_probes ||
                   std::ranges::any_of(taken, [&](const glm::dvec3& probe) {
                       return glm::distance(probe, place) <= rule_.clearance;
                   });
        });
        sort_farthest_first(space.positions, taken, kStartPlaces);
        for (size_t i = 0; i < std::min(space.positions.size(), kStartPlaces); ++i) {
            const glm::dvec3& place = space.positions[i];
            if (i >= kStartProbes) {
                sensors_.push_back(place);
                continue;
            }
            probes_.push_back(place_probe(traced_, place, {rule_.clearance}));
            is_protected_.push_back(false);
        }
        if (!std::ranges::binary_search(wanted_, space.space)) {
            wanted_.insert(std::ranges::upper_bound(wanted_, space.space), space.space);
        }
    }

    /// The minimum number of probes that span what the start spans in each space.
    [[nodiscard]] size_t min_probe_count() const {
        size_t count = 0;
        for (const auto& [space, probes] : probes_by_space()) {
            count += static_cast<size_t>(affine_dimension(probes) + 1);
        }
        return count;
    }

    Result<AdaptiveReport> adapt(const AdaptiveCallback& callback) {
        const size_t min_count = min_probe_count();
        if (min_count > rule_.max_count) {
            return Error{ErrorCode::InvalidArgument, "max_probes", str_cat(rule_.max_count),
                         str_cat(wanted_.size(), " spaces need ", min_count,
                                 " probes at least, more than the limit of ", rule_.max_count)};
        }
        const AdaptiveInput input{
            scene_,
            traced_,
            rule_.bounds,
            rule_.clearance,
            [this](const glm::dvec3& position) { return is_allowed(position); },
            [this](const glm::dvec3& p) { return map_.space_of(p); },
            std::move(sensors_),
            rule_.max_count,
            settings_.thread_count};
        auto report = refine_grid(input, settings_.adaptive, probes_, is_protected_, callback);
        if (report) report->start_spacing = rule_.spacing;
        return report;
    }

    /// True if the adaptive mode may place a probe at a position.
    [[nodiscard]] bool is_allowed(const glm::dvec3& position) const {
        constexpr double kCloser = 0.5;  // sensors in corners may be closer to surfaces
        if (!is_in(rule_.bounds, position)) return false;
        if (adjustment_at(scene_.probe_adjustments, position).forbids_probes) return false;
        return is_free_with_clearance(traced_, position, kCloser * rule_.clearance) &&
               std::ranges::binary_search(wanted_, map_.space_of(position));
    }

    Result<ProbeGrid> make_groups() {
        grid_.candidate_count = probes_.size();
        std::vector<float> distances;
        for (const PlacedProbe& probe : probes_) {
            ++grid_.fate_counts[static_cast<size_t>(probe.fate)];
            if (is_kept(probe.fate)) distances.push_back(probe.surface_distance);
        }
        if (distances.empty()) return Error{ErrorCode::InvalidArgument, none_left(grid_)};
        const std::vector<glm::dvec3> positions = kept_positions(probes_);
        RegionGroups regions =
            group_by_region(positions, map_.spaces_of(positions, settings_.thread_count),
                            {settings_.name, settings_.region_size});
        grid_.groups = std::move(regions.groups);
        for (const uint32_t i : regions.order) grid_.surface_distances.push_back(distances[i]);
        return std::move(grid_);
    }

    const Scene& scene_;
    const TraceScene& traced_;
    const ProbeGridSettings& settings_;
    const CandidateRule& rule_;
    FreeSpaceMap map_;
    std::vector<PlacedProbe> probes_;
    std::vector<bool> is_protected_;   ///< one for each candidate
    std::vector<uint32_t> wanted_;     ///< spaces, sorted
    std::vector<glm::dvec3> sensors_;  ///< in spaces without candidates
    ProbeGrid grid_;
};

}  // namespace

Result<ProbeGrid> make_probe_grid(const Scene& scene, const ProbeGridSettings& settings,
                                  const AdaptiveCallback& callback) {
    const auto bounds = grid_bounds(scene, settings);
    if (!bounds) return bounds.error();
    const auto spacing = candidate_spacing(*bounds, settings);
    if (!spacing) return spacing.error();
    const auto clearance = checked_clearance(*spacing, settings);
    if (!clearance) return clearance.error();
    for (const ProbeAdjustment& adjustment : scene.probe_adjustments) {
        if (auto status = check_adjustment(adjustment); !status) return status.error();
    }
    const CandidateRule rule{padded_bounds(*bounds, *spacing, *clearance, settings),
                             *spacing,
                             *clearance,
                             heights_apart(settings.heights, *clearance),
                             probe_limit(settings),
                             settings.thread_count};
    const Scene canonical = canonical_scene(scene);
    const auto traced = TraceScene::make_static(canonical);
    if (!traced) return traced.error();
    return GridMaker(canonical, *traced, settings, rule).run(callback);
}

}  // namespace tetralight
