// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/spaces.h>

#include <algorithm>
#include <map>
#include <utility>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/probe_visibility.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// Points of a space that are tried; all of them are on the same side of closed surfaces.
constexpr size_t kTriedPoints = 256;
/// Free positions of one space, and of all spaces together.
constexpr size_t kPlacesOfSpace = 64, kAllPlaces = 4096;
/// Spaces without probes and seeds that are smaller are not listed, m³.
constexpr double kLeastVolume = 1.0;

Status check_seed(const TraceScene& traced, const FreeSpaceMap& map, const glm::dvec3& seed) {
    const std::string value = str_cat(seed.x, ",", seed.y, ",", seed.z);
    const auto error = [&](const char* reason) {
        return Error{ErrorCode::InvalidArgument, "from", value,
                     str_cat("seed ", value, " is ", reason)};
    };
    if (!map.contains(seed)) return error("outside of the bounds");
    const glm::vec3 position = traced.render_from_world(seed);
    if (classify_point(traced, position, probe_visibility(traced, position)) ==
        PointClass::Inside) {
        return error("inside geometry");
    }
    if (map.space_of(seed) == kNoIndex) {
        return error("in a gap that is too narrow for the flood fill");
    }
    return Ok{};
}

/// What belongs to one space.
struct Members {
    std::vector<glm::dvec3> points;  ///< of the map, in the bounds
    std::vector<glm::dvec3> probes;
    std::vector<glm::dvec3> seeds;
};

class SpaceSearch {
  public:
    SpaceSearch(const Scene& scene, const TraceScene& traced, FreeSpaceMap& map,
                const SpaceRule& rule)
        : scene_(scene), traced_(traced), map_(map), rule_(rule) {}

    Result<std::vector<MappedSpace>> run(std::vector<PlacedProbe>& probes) {
        for (const glm::dvec3& seed : rule_.seeds) {
            if (auto status = check_seed(traced_, map_, seed); !status) return status.error();
        }
        const std::vector<glm::dvec3> positions = kept_positions(probes);
        map_.join(positions, rule_.thread_count);
        map_.join(rule_.seeds, rule_.thread_count);
        const std::vector<uint32_t> numbers = map_.spaces_of(positions, rule_.thread_count);
        find(positions, numbers);
        if (auto status = find_light(); !status) return status.error();
        choose();
        set_fates(numbers, probes);
        return std::move(spaces_);
    }

  private:
    void find(const std::vector<glm::dvec3>& positions, const std::vector<uint32_t>& numbers) {
        std::map<uint32_t, Members> members;
        for (auto& [number, points] : map_.points_by_space(rule_.bounds)) {
            members[number].points = std::move(points);
        }
        for (size_t i = 0; i < positions.size(); ++i) {
            members[numbers[i]].probes.push_back(positions[i]);
        }
        for (const glm::dvec3& seed : rule_.seeds) {
            members[map_.space_of(seed)].seeds.push_back(seed);
        }
        std::erase_if(members, [&](const auto& item) {
            const Members& some = item.second;
            return some.probes.empty() && some.seeds.empty() && volume_of(some) < kLeastVolume;
        });
        std::vector<std::pair<uint32_t, Members>> list(members.begin(), members.end());
        const size_t count =
            std::clamp<size_t>(kAllPlaces / std::max<size_t>(list.size(), 1), 4, kPlacesOfSpace);
        spaces_.resize(list.size());
        parallel_for(list.size(), rule_.thread_count, [&](size_t i) {
            const auto& [number, some] = list[i];
            MappedSpace& found = spaces_[i];
            found.number = number;
            found.places = free_places(some, count);
            found.space.volume = volume_of(some);
            found.space.probe_count = some.probes.size();
            found.space.has_seed = !some.seeds.empty();
            if (!found.places.empty()) found.space.position = found.places.front();
        });
        // Without a free position: inside solids.
        std::erase_if(spaces_, [](const MappedSpace& found) { return found.places.empty(); });
        std::ranges::stable_sort(spaces_, [](const MappedSpace& a, const MappedSpace& b) {
            return std::pair(a.space.probe_count, a.space.volume) >
                   std::pair(b.space.probe_count, b.space.volume);
        });
    }

    [[nodiscard]] double volume_of(const Members& members) const {
        return static_cast<double>(members.points.size()) * map_.point_volume();
    }

    /// Evenly chosen probes or free points of a space, and its seeds.
    [[nodiscard]] std::vector<glm::dvec3> free_places(const Members& members, size_t count) const {
        const auto chosen = [&](const std::vector<glm::dvec3>& from, size_t most, auto is_fine) {
            std::vector<glm::dvec3> places;
            const size_t tries = std::min(from.size(), kTriedPoints);
            for (size_t i = 0; i < tries && places.size() < most; ++i) {
                const glm::dvec3& place = from[i * from.size() / tries];
                if (is_fine(place)) places.push_back(place);
            }
            return places;
        };
        std::vector<glm::dvec3> places = chosen(members.probes, count / 2, [](auto&) {
            return true;  // free already
        });
        for (const glm::dvec3& seed : members.seeds) places.push_back(seed);
        const auto points = chosen(members.points, count, [&](const glm::dvec3& point) {
            return is_free_with_clearance(traced_, point, rule_.clearance);
        });
        const auto room = static_cast<std::ptrdiff_t>(count - std::min(count, places.size()));
        const auto most = std::min(room, static_cast<std::ptrdiff_t>(points.size()));
        places.insert(places.end(), points.begin(), points.begin() + most);
        return places;
    }

    Status find_light() {
        if (spaces_.empty()) return Ok{};
        std::vector<std::vector<glm::dvec3>> parts;
        for (const MappedSpace& found : spaces_) parts.push_back(found.places);
        const auto light = find_space_light(scene_, parts, rule_.thread_count);
        if (!light) return light.error();
        for (size_t i = 0; i < spaces_.size(); ++i) {
            spaces_[i].space.light = (*light)[i];
            is_any_lit_ = is_any_lit_ || !(*light)[i].is_dark();
        }
        return Ok{};
    }

    /// True if no light reaches a space, but others have some.
    [[nodiscard]] bool is_dark(const Space& space) const {
        return is_any_lit_ && space.light.is_dark();
    }

    /// The fate of a space that is not the first lit one.
    [[nodiscard]] SpaceFate fate_of(const Space& space) const {
        if (space.has_seed) return SpaceFate::Filled;
        if (is_dark(space) && rule_.dark == DarkSpaces::Drop) return SpaceFate::Dark;
        const bool keeps_all = rule_.unreachable == UnreachableSpaces::Keep;
        const bool keeps_dark = is_dark(space) && rule_.seeds.empty();
        return keeps_all || keeps_dark ? SpaceFate::Filled : SpaceFate::Unreachable;
    }

    void choose() {
        bool is_chosen = !rule_.seeds.empty();
        for (MappedSpace& found : spaces_) {
            found.space.fate = fate_of(found.space);
            if (is_chosen || is_dark(found.space) || found.number == kNoIndex) continue;
            found.space.fate = SpaceFate::Filled;
            is_chosen = true;
        }
    }

    void set_fates(const std::vector<uint32_t>& numbers, std::vector<PlacedProbe>& probes) const {
        std::map<uint32_t, SpaceFate> fates;
        for (const MappedSpace& found : spaces_) fates[found.number] = found.space.fate;
        size_t i = 0;
        for (PlacedProbe& probe : probes) {
            if (!is_kept(probe.fate)) continue;
            const SpaceFate fate = fates.at(numbers[i++]);
            if (fate == SpaceFate::Unreachable) probe.fate = Fate::Unreachable;
            if (fate == SpaceFate::Dark) probe.fate = Fate::Dark;
        }
    }

    const Scene& scene_;
    const TraceScene& traced_;
    FreeSpaceMap& map_;
    const SpaceRule& rule_;
    std::vector<MappedSpace> spaces_;
    bool is_any_lit_ = false;
};

}  // namespace

Result<std::vector<MappedSpace>> find_spaces(const Scene& scene, const TraceScene& traced,
                                             FreeSpaceMap& map, const SpaceRule& rule,
                                             std::vector<PlacedProbe>& probes) {
    return SpaceSearch(scene, traced, map, rule).run(probes);
}

}  // namespace tetralight
