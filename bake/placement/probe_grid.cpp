// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/probe_grid.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/adjusted_candidates.h>
#include <tetralight/bake/placement/affine_dimension.h>
#include <tetralight/bake/placement/candidate_count.h>
#include <tetralight/bake/placement/candidates.h>
#include <tetralight/bake/placement/canonical_scene.h>
#include <tetralight/bake/placement/cover_places.h>
#include <tetralight/bake/placement/free_space_map.h>
#include <tetralight/bake/placement/grid_bounds.h>
#include <tetralight/bake/placement/group_by_region.h>
#include <tetralight/bake/placement/place_reflections.h>
#include <tetralight/bake/placement/reach_walls.h>
#include <tetralight/bake/placement/sensors.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// Minimum distance between probes, as a fraction of the spacing: on surfaces, and of those that
/// reach for walls.
constexpr double kCrowdedFraction = 0.5, kSameFraction = 0.25;
/// Places for each probe that are to be covered, their least and their largest number, and the
/// number of those that the report is about.
constexpr size_t kPlacesPerProbe = 8, kMinPlaces = 4096, kMaxPlaces = 1 << 15, kChecked = 4096;
/// The adaptive mode starts with fewer probes than this fraction of its maximum, and covers all
/// places first, even if this takes more probes than the maximum by this factor: it removes some.
constexpr double kStartFraction = 0.9, kCoverFactor = 2.0;

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
                   grid.count(Fate::Unreachable), " unreachable, ", grid.count(Fate::Dark),
                   " without light, ", grid.count(Fate::Forbidden), " forbidden");
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

Status check_reflection_spacing(const ProbeGridSettings& settings) {
    const double spacing = settings.reflection_spacing.value_or(1.0);
    if (spacing > 0.0 && std::isfinite(spacing)) return Ok{};
    return Error{ErrorCode::InvalidArgument, "reflection_spacing", str_cat(spacing),
                 str_cat("reflection_spacing ", spacing, " is not a positive length")};
}

/// The stages of one grid.
class GridMaker {
  public:
    GridMaker(const Scene& scene, const TraceScene& traced, const ProbeGridSettings& settings,
              const CandidateRule& rule, double agent_radius)
        : scene_(scene),
          traced_(traced),
          settings_(settings),
          rule_(rule),
          agent_radius_(agent_radius),
          map_(traced, {rule.bounds, rule.spacing, agent_radius, rule.thread_count}),
          places_(traced, rule.bounds, place_clearance(),
                  [this](const glm::dvec3& position) { return is_to_cover(position); }) {}

    Result<ProbeGrid> run(const AdaptiveCallback& callback) {
        if (auto status = place(); !status) return status.error();
        const SpaceRule spaces{rule_.bounds,          rule_.clearance, settings_.from,
                               settings_.unreachable, settings_.dark,  rule_.thread_count};
        auto found = find_spaces(scene_, traced_, map_, spaces, probes_);
        if (!found) return found.error();
        take_spaces(*found);
        cover();
        if (is_adaptive() && !kept_positions(probes_).empty()) {
            auto report = adapt(callback);
            if (!report) return report.error();
            grid_.adaptive = *report;
        }
        return make_groups();
    }

  private:
    [[nodiscard]] bool is_adaptive() const { return settings_.mode == PlacementMode::Adaptive; }

    Status place() {
        constexpr double kWider = 1.15;
        const glm::dvec3 size = rule_.bounds.size();
        while (true) {
            if (auto status = place_once(); !status) return status;
            const auto most = kStartFraction * static_cast<double>(rule_.max_count);
            const auto count = static_cast<double>(kept_positions(probes_).size());
            const bool is_widest = smallest(rule_.spacing) > std::max({size.x, size.y, size.z});
            if (!is_adaptive() || count <= most || is_widest) break;
            rule_.spacing *= kWider;
        }
        for (const ProbeAdjustment& adjustment : scene_.probe_adjustments) {
            const bool is_outside = !bounds_in(rule_.bounds, adjustment);
            if (is_outside) grid_.adjustments_outside.push_back(adjustment.name);
        }
        if (is_adaptive()) return Ok{};
        return check_candidate_count(static_cast<double>(kept_positions(probes_).size()),
                                     rule_.max_count);
    }

    Status place_once() {
        CandidateRule rule = rule_;
        // The smallest lattice has eight probes; the adaptive mode removes some.
        constexpr uint64_t kFewest = 8;
        if (is_adaptive()) rule.max_count = std::max(rule.max_count, kFewest);
        auto candidates =
            adjusted_candidates(traced_, scene_.probe_adjustments, settings_.mode, rule);
        if (!candidates) return candidates.error();
        probes_ = place_candidates(traced_, scene_.probe_adjustments, *candidates, rule_);
        is_protected_.clear();
        for (const Candidate& candidate : *candidates) {
            is_protected_.push_back(candidate.is_adjusted);
        }
        keep_walkable();
        reach_out(*candidates);
        if (settings_.mode == PlacementMode::Surface) {
            drop_crowded(traced_, kCrowdedFraction * smallest(rule_.spacing), probes_);
        }
        return Ok{};
    }

    /// Drops what nothing on the walkable surface reaches.
    void keep_walkable() {
        if (rule_.walkable == nullptr) return;
        for (PlacedProbe& probe : probes_) {
            if (is_kept(probe.fate) && !is_walkable(probe.position)) probe.fate = Fate::Unreachable;
        }
    }

    [[nodiscard]] bool is_walkable(const glm::dvec3& position) const {
        return rule_.walkable == nullptr || rule_.walkable->holds(position, settings_.agent_height);
    }

    /// Where probes may reach out to.
    [[nodiscard]] ReachRule reach_rule() const {
        // Probes do not lie on surfaces, even without a clearance.
        constexpr double kLeast = 1e-3;  // of the spacing
        const double clearance = std::max(rule_.clearance, kLeast * smallest(rule_.spacing));
        ReachRule rule{rule_.bounds, clearance, glm::bvec3(true), {}};
        rule.axes.y = settings_.mode != PlacementMode::Layers;
        if (rule_.walkable == nullptr) return rule;
        rule.holds = [this](const glm::dvec3& position) { return is_walkable(position); };
        return rule;
    }

    /// Takes the last layers to the walls.
    void reach_out(const std::vector<Candidate>& candidates) {
        const ReachRule rule = reach_rule();
        std::vector<std::vector<glm::dvec3>> reached(candidates.size());
        parallel_for(candidates.size(), rule_.thread_count, [&](size_t i) {
            if (!is_kept(probes_[i].fate)) return;
            const glm::dvec3 spacing = in_bounds(candidates[i].spacing);
            reached[i] = reach_walls(traced_, probes_[i].position, spacing, rule);
        });
        double same = smallest(in_bounds(rule_.spacing));
        for (const Candidate& candidate : candidates) {
            same = std::min(same, smallest(in_bounds(candidate.spacing)));
        }
        for (size_t i = 0; i < candidates.size(); ++i) {
            std::vector<glm::dvec3>& places = reached[i];
            if (places.empty()) continue;
            const auto self = std::ranges::find(places, probes_[i].position);
            if (self != places.end()) {
                places.erase(self);
            } else {
                probes_[i].position = places.front();
                probes_[i].fate = Fate::Pushed;
                places.erase(places.begin());
            }
            for (const glm::dvec3& place : places) add(place, is_protected_[i]);
        }
        align();
        drop_same(kSameFraction * same, candidates.size());
        measure_distances();
    }

    /// The spacing, where an axis of the bounds that is short has two layers.
    [[nodiscard]] glm::dvec3 in_bounds(glm::dvec3 spacing) const {
        constexpr double kFlat = 0.001;  // of the spacing: such an axis has one layer
        for (int axis = 0; axis < 3; ++axis) {
            const double size = rule_.bounds.size()[axis];
            if (size >= kFlat * spacing[axis]) spacing[axis] = std::min(spacing[axis], 0.5 * size);
        }
        return spacing;
    }

    void add(const glm::dvec3& position, bool is_protected) {
        if (adjustment_at(scene_.probe_adjustments, position).forbids_probes) return;
        if (!is_walkable(position)) return;
        probes_.push_back({position, Fate::Added, 0.0f});
        is_protected_.push_back(is_protected);
    }

    void align() {
        constexpr double kTolerance = 4e-3;  // of the clearance
        if (!(rule_.clearance > 0.0)) return;
        std::vector<glm::dvec3> positions = kept_positions(probes_);
        align_planes(positions, kTolerance * rule_.clearance);
        size_t i = 0;
        for (PlacedProbe& probe : probes_) {
            if (is_kept(probe.fate)) probe.position = positions[i++];
        }
    }

    /// Drops what several candidates reached. Candidates keep their fates.
    void drop_same(double distance, size_t candidate_count) {
        const std::vector<bool> is_same = find_crowded(traced_, kept_positions(probes_), distance);
        std::vector<PlacedProbe> left;
        std::vector<bool> left_protected;
        size_t k = 0;
        for (size_t i = 0; i < probes_.size(); ++i) {
            const bool is_dropped = is_kept(probes_[i].fate) && is_same[k++];
            if (is_dropped && i >= candidate_count) continue;
            if (is_dropped) probes_[i].fate = Fate::Crowded;
            left.push_back(probes_[i]);
            left_protected.push_back(is_protected_[i]);
        }
        probes_ = std::move(left);
        is_protected_ = std::move(left_protected);
    }

    void measure_distances() {
        parallel_for(probes_.size(), rule_.thread_count, [&](size_t i) {
            if (is_kept(probes_[i].fate)) probes_[i].surface_distance = distance_of(probes_[i]);
        });
    }

    [[nodiscard]] float distance_of(const PlacedProbe& probe) const {
        return surface_distance(traced_, traced_.render_from_world(probe.position));
    }

    void take_spaces(std::vector<MappedSpace>& found) {
        for (MappedSpace& some : found) {
            grid_.spaces.push_back(some.space);
            if (some.space.fate != SpaceFate::Filled) continue;
            filled_[some.number] = grid_.spaces.size() - 1;
            std::ranges::copy_if(some.places, std::back_inserter(space_places_),
                                 [this](const glm::dvec3& place) { return is_to_cover(place); });
        }
    }

    /// The distance of places to be covered from surfaces, metres.
    [[nodiscard]] double place_clearance() const {
        return rule_.clearance + std::min(0.01, 0.1 * rule_.clearance);
    }

    /// True if objects may be at a position, and probes.
    [[nodiscard]] bool is_to_cover(const glm::dvec3& position) const {
        // The height first: it takes one ray.
        return is_at_height(position) && is_allowed(position, place_clearance());
    }

    /// With layers: true between the lowest and the highest of their heights.
    [[nodiscard]] bool is_at_height(const glm::dvec3& position) const {
        if (settings_.mode != PlacementMode::Layers) return true;
        const auto [low, high] = std::ranges::minmax(rule_.heights);
        const auto height = rule_.walkable == nullptr ? height_above_floor(traced_, position)
                                                      : rule_.walkable->height_above(position);
        return height && *height >= low && *height <= high;
    }

    [[nodiscard]] bool is_allowed(const glm::dvec3& position, double clearance) const {
        if (!is_in(rule_.bounds, position) || !is_walkable(position)) return false;
        if (adjustment_at(scene_.probe_adjustments, position).forbids_probes) return false;
        return is_free_with_clearance(traced_, position, clearance) &&
               filled_.contains(map_.space_of(position));
    }

    /// Adds probes until places in the filled spaces are inside the tetrahedra and in sight.
    void cover() {
        const std::vector<glm::dvec3> probes = kept_positions(probes_);
        std::vector<glm::dvec3> places =
            places_.next(std::clamp(kPlacesPerProbe * probes.size(), kMinPlaces, kMaxPlaces),
                         rule_.thread_count);
        places.insert(places.end(), space_places_.begin(), space_places_.end());
        auto most = static_cast<double>(rule_.max_count);
        if (is_adaptive()) most *= kCoverFactor;
        const auto count = static_cast<double>(probes.size());
        const CoverRule rule{
            reach_rule(), smallest(rule_.spacing),
            [this](const glm::dvec3& position) { return is_allowed(position, rule_.clearance); },
            static_cast<size_t>(std::max(most - count, 0.0)), rule_.thread_count};
        for (const glm::dvec3& probe : cover_places(traced_, probes, places, rule)) {
            add(probe, false);
            probes_.back().surface_distance = distance_of(probes_.back());
        }
    }

    /// The minimum number of probes that span what the start spans in each space.
    [[nodiscard]] size_t min_probe_count() const {
        const std::vector<glm::dvec3> positions = kept_positions(probes_);
        const std::vector<uint32_t> spaces = map_.spaces_of(positions, rule_.thread_count);
        std::map<uint32_t, std::vector<glm::dvec3>> probes;
        for (size_t i = 0; i < spaces.size(); ++i) probes[spaces[i]].push_back(positions[i]);
        size_t count = 0;
        for (const auto& [space, some] : probes) {
            count += static_cast<size_t>(affine_dimension(some) + 1);
        }
        return count;
    }

    Result<AdaptiveReport> adapt(const AdaptiveCallback& callback) {
        const size_t min_count = min_probe_count();
        if (min_count > rule_.max_count) {
            return Error{
                ErrorCode::InvalidArgument, "max_probes", str_cat(rule_.max_count),
                str_cat(filled_.size(), filled_.size() == 1 ? " space needs " : " spaces need ",
                        min_count, " probes at least, more than the limit of ", rule_.max_count)};
        }
        constexpr double kCloser = 0.5;  // sensors in corners may be closer to surfaces
        const AdaptiveInput input{scene_,
                                  traced_,
                                  rule_.bounds,
                                  rule_.clearance,
                                  place_clearance(),
                                  [this](const glm::dvec3& position) {
                                      return is_allowed(position, kCloser * rule_.clearance);
                                  },
                                  [this](const glm::dvec3& p) { return map_.space_of(p); },
                                  space_places_,
                                  rule_.max_count,
                                  settings_.thread_count};
        auto report = refine_grid(input, settings_.adaptive, probes_, is_protected_, callback);
        if (report) report->start_spacing = rule_.spacing;
        return report;
    }

    /// Looks at places that no decision was about.
    void measure_coverage(const std::vector<glm::dvec3>& probes) {
        std::vector<glm::dvec3> places = places_.next(kChecked, rule_.thread_count);
        const std::vector<Cover> covers = cover_by(traced_, probes, places, rule_.thread_count);
        grid_.coverage = count_cover(covers);
        for (size_t i = 0; i < places.size(); ++i) {
            if (covers[i] != Cover::Covered) grid_.uncovered.push_back({places[i], covers[i]});
        }
    }

    void place_reflection_probes() {
        if (!settings_.reflection_spacing) return;
        // A wider body leaves no points in corridors.
        constexpr double kNarrowest = 0.2, kWidest = 0.4;
        const ReflectionRule rule{
            rule_.bounds,
            *settings_.reflection_spacing,
            std::clamp(agent_radius_, kNarrowest, kWidest),
            scene_.probe_adjustments,
            [this](const glm::dvec3& position) {
                const bool is_walkable_below =
                    rule_.walkable == nullptr || rule_.walkable->height_above(position);
                return is_walkable_below && filled_.contains(map_.space_of(position));
            },
            rule_.thread_count};
        grid_.reflection_places = place_reflections(traced_, rule);
    }

    Result<ProbeGrid> make_groups() {
        grid_.candidate_count = probes_.size();
        std::vector<float> distances;
        for (const PlacedProbe& probe : probes_) {
            ++grid_.fate_counts[static_cast<size_t>(probe.fate)];
            if (is_kept(probe.fate)) distances.push_back(probe.surface_distance);
        }
        if (distances.empty()) {
            std::string message = none_left(grid_);
            if (rule_.walkable != nullptr) {
                message += str_cat("; probes stand up to ", settings_.agent_height,
                                   " m above the walkable surface only");
            }
            return Error{ErrorCode::InvalidArgument, message};
        }
        const std::vector<glm::dvec3> positions = kept_positions(probes_);
        const std::vector<uint32_t> spaces = map_.spaces_of(positions, settings_.thread_count);
        for (const auto& [number, i] : filled_) {
            grid_.spaces[i].probe_count = static_cast<uint64_t>(std::ranges::count(spaces, number));
        }
        measure_coverage(positions);
        place_reflection_probes();
        RegionGroups regions =
            group_by_region(positions, spaces, {settings_.name, settings_.region_size});
        grid_.groups = std::move(regions.groups);
        for (const uint32_t i : regions.order) grid_.surface_distances.push_back(distances[i]);
        return std::move(grid_);
    }

    const Scene& scene_;
    const TraceScene& traced_;
    const ProbeGridSettings& settings_;
    CandidateRule rule_;
    double agent_radius_;
    FreeSpaceMap map_;
    SensorSequence places_;
    std::vector<PlacedProbe> probes_;
    std::vector<bool> is_protected_;        ///< one for each of `probes_`
    std::map<uint32_t, size_t> filled_;     ///< number in the map → index in the report
    std::vector<glm::dvec3> space_places_;  ///< in filled spaces, which may be small
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
    const auto agent_radius = checked_agent_radius(*spacing, settings);
    if (!agent_radius) return agent_radius.error();
    if (auto status = check_reflection_spacing(settings); !status) return status.error();
    for (const ProbeAdjustment& adjustment : scene.probe_adjustments) {
        if (auto status = check_adjustment(adjustment); !status) return status.error();
    }
    CandidateRule rule{padded_bounds(*bounds, *spacing, *clearance, settings),
                       *spacing,
                       *clearance,
                       heights_apart(settings.heights, *clearance),
                       probe_limit(settings),
                       settings.thread_count};
    const auto triangles =
        settings.walkable.empty() ? walkable_triangles(scene) : settings.walkable;
    std::optional<WalkableSurface> walkable;
    if (!triangles.empty()) {
        auto made = WalkableSurface::make(triangles);
        if (!made) return made.error();
        rule.walkable = &walkable.emplace(std::move(*made));
    }
    const Scene canonical = canonical_scene(scene);
    const auto traced = TraceScene::make_static(canonical);
    if (!traced) return traced.error();
    return GridMaker(canonical, *traced, settings, rule, *agent_radius).run(callback);
}

}  // namespace tetralight
