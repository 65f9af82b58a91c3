// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/cover_places.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/free_space.h>
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
            if (covers[i] != Cover::Covered && is_hopeless_[i] == 0) wishes.push_back({i, 0.0});
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
        const size_t before = all.size();
        for (const Wish& wish : wishes) {
            if (all.size() >= max_count) return;
            const glm::dvec3 probe = probe_for(places_[wish.place]);
            const auto added = std::span(all).subspan(before);
            const double apart = kApart * std::min(wish.room, rule_.reach);
            const bool is_crowded = std::ranges::any_of(added, [&](const glm::dvec3& other) {
                return glm::distance(probe, other) < apart &&
                       is_visible(traced_, traced_.render_from_world(probe),
                                  traced_.render_from_world(other));
            });
            if (is_crowded) continue;
            // A probe there would hardly differ from one that does not help.
            const double least = 0.5 * rule_.clearance;
            if (nearest(probe, all) <= least || !rule_.is_allowed(probe)) {
                is_hopeless_[wish.place] = 1;
                continue;
            }
            all.push_back(probe);
        }
    }

    /// The place, moved towards the nearest wall: what lies between them is covered as well.
    [[nodiscard]] glm::dvec3 probe_for(const glm::dvec3& place) const {
        const glm::vec3 here = traced_.render_from_world(place);
        const auto surface = traced_.nearest_surface(here);
        if (!surface) return place;
        constexpr double kSlack = 1e-3;
        const double distance = glm::distance(here, *surface);
        const double way = distance - (1.0 + kSlack) * rule_.clearance;
        if (!(way > 0.0) || way > rule_.reach) return place;
        const auto fraction = static_cast<float>(way / distance);
        const glm::vec3 there = here + fraction * (*surface - here);
        const glm::dvec3 moved = traced_.world_from_render(there);
        return is_free_with_clearance(traced_, moved, rule_.clearance) ? moved : place;
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
    return find_cover(traced, volume.view(), places, thread_count);
}

}  // namespace tetralight
