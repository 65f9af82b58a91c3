// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/rooms.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/free_space.h>
#include <tetralight/probes/no_index.h>

namespace tetralight {
namespace {

constexpr double kRoomStep = 0.125, kMostRoomPoints = 1 << 20;
/// Distances to surfaces are cut off here, metres: wider places are all alike.
constexpr float kWideRoom = 1.5f;
/// A way that is narrower than this fraction of the smaller part separates rooms.
constexpr float kNarrower = 0.8f;
constexpr double kLeastRoom = 2.0;  // m³

Lattice room_lattice(const WorldBox& bounds) {
    double step = kRoomStep;
    const auto count_along = [&](int axis) {
        return std::max(1.0, std::ceil(bounds.size()[axis] / step));
    };
    while (count_along(0) * count_along(1) * count_along(2) > kMostRoomPoints) step *= 1.1;
    Lattice lattice;
    for (int axis = 0; axis < 3; ++axis) {
        const double count = count_along(axis);
        const double first = bounds.center()[axis] - 0.5 * (count - 1.0) * step;
        lattice.axes[axis] = {first, step, static_cast<uint64_t>(count)};
    }
    return lattice;
}

/// The parts of space around local maxima of the distance to surfaces, joined by union-find.
class Basins {
  public:
    /// Precondition: peaks do not increase from call to call.
    uint32_t add(float peak) {
        parents_.push_back(static_cast<uint32_t>(parents_.size()));
        peaks_.push_back(peak);
        return parents_.back();
    }

    [[nodiscard]] uint32_t root(uint32_t basin) const {
        while (parents_[basin] != basin) basin = parents_[basin];
        return basin;
    }

    /// Joins two basins that touch where the distance is `saddle`, unless that is narrow.
    void touch(uint32_t a, uint32_t b, float saddle) {
        a = root(a);
        b = root(b);
        if (a == b) return;
        // The basin that was added first has the higher peak.
        const uint32_t higher = std::min(a, b), lower = std::max(a, b);
        if (saddle >= kNarrower * peaks_[lower]) parents_[lower] = higher;
    }

  private:
    std::vector<uint32_t> parents_;
    std::vector<float> peaks_;
};

/// The stages of one map.
class RoomSearch {
  public:
    RoomSearch(const TraceScene& traced, const RoomRule& rule) : traced_(traced), rule_(rule) {
        map_.lattice = room_lattice(rule.bounds);
    }

    RoomMap run() {
        measure();
        const std::vector<uint32_t> order = covered_by_distance();
        for (const uint32_t point : order) assign(point);
        collect(order);
        return std::move(map_);
    }

  private:
    enum class Kind : uint8_t { Near, Open, Covered };

    [[nodiscard]] glm::vec3 place(uint64_t point) const {
        return traced_.render_from_world(map_.lattice.at(point));
    }

    void measure() {
        const uint64_t count = map_.lattice.count();
        map_.distances.resize(count);
        kinds_.assign(count, Kind::Near);
        basin_of_.assign(count, kNoIndex);
        parallel_for(count, rule_.thread_count, [&](size_t i) {
            const glm::vec3 position = place(i);
            const auto nearest = traced_.nearest_surface(position, kWideRoom);
            const float distance = nearest ? glm::distance(*nearest, position) : kWideRoom;
            map_.distances[i] = distance;
            if (distance < static_cast<float>(rule_.clearance)) return;
            const auto ceiling = traced_.nearest_crossing({position, glm::vec3(0, 1, 0)});
            kinds_[i] = ceiling ? Kind::Covered : Kind::Open;
        });
    }

    /// Points with a ceiling, those farthest from surfaces first. Fills `open_points`.
    [[nodiscard]] std::vector<uint32_t> covered_by_distance() {
        std::vector<uint32_t> covered;
        for (uint32_t i = 0; i < kinds_.size(); ++i) {
            if (kinds_[i] == Kind::Covered) covered.push_back(i);
            if (kinds_[i] == Kind::Open) map_.open_points.push_back(i);
        }
        std::ranges::stable_sort(covered, std::greater{},
                                 [&](uint32_t point) { return map_.distances[point]; });
        return covered;
    }

    /// Puts a point into the basin of its neighbor farthest from surfaces, and joins basins that
    /// touch here.
    void assign(uint32_t point) {
        const std::vector<uint32_t> neighbors = neighbors_of(point);
        if (neighbors.empty()) {
            basin_of_[point] = basins_.add(map_.distances[point]);
            return;
        }
        const auto farthest = std::ranges::max_element(
            neighbors, {}, [&](uint32_t other) { return map_.distances[other]; });
        const uint32_t basin = basin_of_[*farthest];
        basin_of_[point] = basin;
        for (const uint32_t other : neighbors) {
            basins_.touch(basin, basin_of_[other], map_.distances[point]);
        }
    }

    /// The neighbors of a point that were assigned before it and that no surface separates from it.
    [[nodiscard]] std::vector<uint32_t> neighbors_of(uint32_t point) const {
        std::vector<uint32_t> neighbors;
        const glm::ivec3 layers = layers_of(map_.lattice, point);
        for (int axis = 0; axis < 3; ++axis) {
            for (const int way : {-1, 1}) {
                glm::ivec3 there = layers;
                there[axis] += way;
                if (!is_in(map_.lattice, there)) continue;
                const auto other = static_cast<uint32_t>(index_at(map_.lattice, there));
                if (basin_of_[other] != kNoIndex && is_linked(point, other)) {
                    neighbors.push_back(other);
                }
            }
        }
        return neighbors;
    }

    /// Two balls that overlap have no surface in them.
    [[nodiscard]] bool is_linked(uint32_t a, uint32_t b) const {
        const glm::vec3 from = place(a), to = place(b);
        return map_.distances[a] + map_.distances[b] > glm::distance(from, to) ||
               is_visible(traced_, from, to);
    }

    void collect(const std::vector<uint32_t>& order) {
        std::map<uint32_t, std::vector<uint32_t>> rooms;
        for (const uint32_t point : order) rooms[basins_.root(basin_of_[point])].push_back(point);
        for (auto& [basin, points] : rooms) {
            if (static_cast<double>(points.size()) * map_.point_volume() < kLeastRoom) continue;
            std::ranges::sort(points);
            map_.rooms.push_back(std::move(points));
        }
        std::ranges::stable_sort(map_.rooms, std::greater{},
                                 [](const auto& points) { return points.size(); });
    }

    const TraceScene& traced_;
    const RoomRule& rule_;
    RoomMap map_;
    std::vector<Kind> kinds_;
    Basins basins_;
    std::vector<uint32_t> basin_of_;
};

}  // namespace

double RoomMap::point_volume() const {
    return lattice.axes[0].spacing * lattice.axes[1].spacing * lattice.axes[2].spacing;
}

RoomMap find_rooms(const TraceScene& traced, const RoomRule& rule) {
    return RoomSearch(traced, rule).run();
}

}  // namespace tetralight
