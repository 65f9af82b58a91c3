// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/cover_places.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/reach_walls.h>
#include <tetralight/probes/build/make_probe_volume.h>

namespace tetralight {
namespace {

constexpr int kMaxRounds = 32;
/// Fewer uncovered places than this fraction are left.
constexpr double kLeft = 0.002;
/// New probes of one round that see each other are this far apart, as a fraction of the distance to
/// the nearest probe before it.
constexpr double kApart = 0.7;

/// A place that wants a probe.
struct Wish {
    size_t place = 0;
    Cover cover = Cover::HullCell;
    double room = 0.0;  ///< metres to the nearest probe
};

class CoverSearch {
  public:
    CoverSearch(const TraceScene& traced, std::span<const glm::dvec3> places, const CoverRule& rule)
        : traced_(traced), places_(places), rule_(rule), is_hopeless_(places.size(), 0) {}

    std::vector<glm::dvec3> run(std::span<const glm::dvec3> probes) {
        std::vector<glm::dvec3> all(probes.begin(), probes.end());
        const auto few = static_cast<size_t>(kLeft * static_cast<double>(places_.size()));
        for (int round = 0; round < kMaxRounds; ++round) {
            std::vector<Wish> wishes = find_wishes(all);
            if (wishes.size() <= few) break;
            const size_t before = all.size();
            add_apart(wishes, probes.size() + rule_.max_count, all);
            if (all.size() == before) break;
        }
        return {all.begin() + static_cast<std::ptrdiff_t>(probes.size()), all.end()};
    }

  private:
    /// The uncovered places, those in most room first.
    [[nodiscard]] std::vector<Wish> find_wishes(const std::vector<glm::dvec3>& probes) const {
        const auto covers = cover_by(traced_, probes, places_, rule_.thread_count);
        std::vector<Wish> wishes;
        for (size_t i = 0; i < places_.size(); ++i) {
            if (covers[i] != Cover::Covered && is_hopeless_[i] == 0)
                wishes.push_back({i, covers[i], 0.0});
        }
        parallel_for(wishes.size(), rule_.thread_count,
                     [&](size_t i) { wishes[i].room = nearest(places_[wishes[i].place], probes); });
        std::ranges::stable_sort(wishes, std::greater{}, &Wish::room);
        return wishes;
    }

    [[nodiscard]] static double nearest(const glm::dvec3& place,
                                        std::span<const glm::dvec3> probes) {
        double room = std::numeric_limits<double>::infinity();
        for (const glm::dvec3& probe : probes) room = std::min(room, glm::distance(place, probe));
        return room;
    }

    void add_apart(const std::vector<Wish>& wishes, size_t max_count,
                   std::vector<glm::dvec3>& all) {
        std::vector<std::vector<glm::dvec3>> offers(wishes.size());
        parallel_for(wishes.size(), rule_.thread_count,
                     [&](size_t i) { offers[i] = offers_for(wishes[i], all); });
        const size_t before = all.size();
        for (size_t i = 0; i < wishes.size() && all.size() < max_count; ++i) {
            const double apart = kApart * std::min(wishes[i].room, rule_.reach);
            if (offers[i].empty()) is_hopeless_[wishes[i].place] = 1;
            for (const glm::dvec3& offer : offers[i]) {
                if (is_crowded(offer, apart, std::span(all).subspan(before))) break;
                if (nearest(offer, std::span(all).subspan(before)) <= least_distance()) continue;
                all.push_back(offer);
                break;
            }
        }
    }

    /// A probe that is closer to another one would hardly differ from it.
    [[nodiscard]] double least_distance() const { return 0.5 * rule_.ends.clearance; }

    [[nodiscard]] bool is_crowded(const glm::dvec3& probe, double apart,
                                  std::span<const glm::dvec3> added) const {
        return std::ranges::any_of(added, [&](const glm::dvec3& other) {
            return glm::distance(probe, other) < apart &&
                   is_visible(traced_, traced_.render_from_world(probe),
                              traced_.render_from_world(other));
        });
    }

    /// Positions that may have a probe for a place, the best first.
    [[nodiscard]] std::vector<glm::dvec3> offers_for(const Wish& wish,
                                                     const std::vector<glm::dvec3>& probes) const {
        const glm::dvec3& place = places_[wish.place];
        std::vector<glm::dvec3> offers;
        if (wish.cover == Cover::HullCell) offers = ends_around(place, probes);
        offers.push_back(place);
        std::erase_if(offers, [&](const glm::dvec3& offer) {
            return nearest(offer, probes) <= least_distance() || !rule_.is_allowed(offer);
        });
        return offers;
    }

    /// Where walls and the bounds end the space around a place, in sight of it; those far from
    /// probes first.
    [[nodiscard]] std::vector<glm::dvec3> ends_around(const glm::dvec3& place,
                                                      const std::vector<glm::dvec3>& probes) const {
        std::vector<glm::dvec3> ends =
            reach_walls(traced_, place, glm::dvec3(rule_.reach), rule_.ends);
        const glm::vec3 here = traced_.render_from_world(place);
        std::erase_if(ends, [&](const glm::dvec3& end) {
            return !is_visible(traced_, here, traced_.render_from_world(end));
        });
        std::ranges::stable_sort(ends, std::greater{},
                                 [&](const glm::dvec3& end) { return nearest(end, probes); });
        return ends;
    }

    const TraceScene& traced_;
    std::span<const glm::dvec3> places_;
    const CoverRule& rule_;
    std::vector<uint8_t> is_hopeless_;  ///< no probe may be there
};

}  // namespace

std::vector<glm::dvec3> cover_places(const TraceScene& traced, std::span<const glm::dvec3> probes,
                                     std::span<const glm::dvec3> places, const CoverRule& rule) {
    return CoverSearch(traced, places, rule).run(probes);
}

std::vector<Cover> cover_by(const TraceScene& traced, std::span<const glm::dvec3> probes,
                            std::span<const glm::dvec3> places, uint32_t thread_count) {
    MergedProbes merged;
    merged.positions.assign(probes.begin(), probes.end());
    const ProbeVolume volume = make_probe_volume(merged);
    const ProbeVolumeView view = volume.view();
    std::vector<Cover> covers = find_cover(traced, view, places, thread_count);
    if (view.info.dimension == Dimension::Space) return covers;
    for (size_t i = 0; i < places.size(); ++i) {
        const CellLocation location = locate(view, glm::vec3(places[i]));
        if (is_off_flat_cell(view, location, places[i])) covers[i] = Cover::HullCell;
    }
    return covers;
}

}  // namespace tetralight
