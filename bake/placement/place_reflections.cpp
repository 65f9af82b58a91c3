// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/place_reflections.h>

#include <algorithm>
#include <array>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <optional>
#include <utility>

#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/place_outdoors.h>
#include <tetralight/bake/placement/room_box.h>
#include <tetralight/bake/placement/rooms.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr int kRoomImportance = 2;
/// Sides of a room, of six, that must be walls.
constexpr int kLeastWalls = 4;
constexpr double kLeastSide = 0.8;  // of a room, metres
/// A room whose box is open to the sky in a larger part is split.
constexpr double kOpenFraction = 0.15;
/// Of a room's points: inside the box of a larger room, it has no probe.
constexpr double kSharedFraction = 0.8;
/// Points of a room that decide whether it is to be filled.
constexpr size_t kAskedPoints = 16;

/// Of a place along the axes of the world.
WorldBox box_around(const ReflectionPlace& place) {
    const glm::dvec3 center = place.position + glm::dvec3(place.box_center);
    const glm::dvec3 half_size(place.half_size);
    return {center - half_size, center + half_size};
}

/// 0 if they overlap.
double distance_between(const WorldBox& a, const WorldBox& b) {
    return glm::length(glm::max(glm::max(a.min - b.max, b.min - a.max), glm::dvec3(0.0)));
}

class ReflectionPlacer {
  public:
    ReflectionPlacer(const TraceScene& traced, const ReflectionRule& rule)
        : traced_(traced),
          rule_(rule),
          map_(find_rooms(traced, {rule.bounds, rule.clearance, rule.thread_count})) {}

    std::vector<ReflectionPlace> run() {
        place_rooms();
        fit_blend_distances();
        std::ranges::move(place_outdoors(traced_, rule_, map_, boxes_),
                          std::back_inserter(places_));
        return std::move(places_);
    }

  private:
    /// The points of a room, and its box.
    struct FittedRoom {
        std::vector<uint32_t> points;
        RoomBox fitted;
    };

    [[nodiscard]] FittedRoom fit(std::vector<uint32_t> points) const {
        const RoomBox fitted = fit_room_box(traced_, map_, points, rule_.clearance);
        return {std::move(points), fitted};
    }

    /// The rooms, of which furniture parts none, the largest first.
    [[nodiscard]] std::vector<FittedRoom> fit_rooms() {
        const double gap = 2.0 * map_.lattice.axes[0].spacing;
        std::vector<FittedRoom> rooms;
        for (std::vector<uint32_t>& points : map_.rooms) {
            FittedRoom room = fit(std::move(points));
            const auto is_part = [&](const FittedRoom& other) {
                return are_parts_of_one_room(room.fitted, other.fitted, gap);
            };
            for (auto part = std::ranges::find_if(rooms, is_part); part != rooms.end();
                 part = std::ranges::find_if(rooms, is_part)) {
                std::vector<uint32_t> all;
                std::ranges::merge(room.points, part->points, std::back_inserter(all));
                rooms.erase(part);
                room = fit(std::move(all));
            }
            rooms.push_back(std::move(room));
        }
        std::ranges::stable_sort(rooms, std::greater{},
                                 [](const FittedRoom& room) { return room.points.size(); });
        return rooms;
    }

    void place_rooms() {
        std::vector<uint32_t> outdoors;
        for (const auto& [room, fitted] : fit_rooms()) {
            if (fitted.wall_count < kLeastWalls) {
                // A bridge, a tree: the space below it is outdoors.
                outdoors.insert(outdoors.end(), room.begin(), room.end());
            } else if (is_filled(room)) {
                place_room(room, fitted.box, 0);
            }
        }
        map_.open_points.insert(map_.open_points.end(), outdoors.begin(), outdoors.end());
        std::ranges::sort(map_.open_points);
    }

    /// Rooms beside each other blend over the thickness of the wall between them: through its
    /// doors, and not behind it.
    void fit_blend_distances() {
        constexpr float kThickestWall = 2.5f;  // as a multiple of the blend distance
        std::vector<WorldBox> boxes;
        std::ranges::transform(places_, std::back_inserter(boxes), box_around);
        for (size_t i = 0; i < boxes.size(); ++i) {
            float& blend_distance = places_[i].blend_distance;
            float nearest = kThickestWall * blend_distance;
            for (const WorldBox& other : boxes) {
                const float distance = static_cast<float>(distance_between(boxes[i], other));
                if (distance > 0.0f && distance < nearest) nearest = blend_distance = distance;
            }
        }
    }

    /// One probe, or several in an arcade around a court, which no box is to hold.
    void place_room(const std::vector<uint32_t>& room, const WorldBox& box, int depth) {
        constexpr int kMostSplits = 3;
        if (depth < kMostSplits && open_fraction(box) > kOpenFraction) {
            for (const auto& half : halves_of(room, box)) {
                if (!half.empty()) place_room(half, fit(half).fitted.box, depth + 1);
            }
            return;
        }
        const glm::dvec3 size = box.size();
        if (std::min({size.x, size.y, size.z}) < kLeastSide || is_in_larger_room(room)) return;
        boxes_.push_back(box);
        const auto position = position_in(room, box.center());
        if (!position) return;
        places_.push_back(make_reflection_place(*position, box, kRoomImportance));
        places_.back().name = str_cat("room ", places_.size());
    }

    /// The points of a room on both sides of the middle of its longer side.
    [[nodiscard]] std::array<std::vector<uint32_t>, 2> halves_of(const std::vector<uint32_t>& room,
                                                                 const WorldBox& box) const {
        const int axis = box.size().x >= box.size().z ? 0 : 2;
        const double middle = box.center()[axis];
        std::array<std::vector<uint32_t>, 2> halves;
        for (const uint32_t point : room) {
            halves[map_.lattice.at(point)[axis] < middle ? 0 : 1].push_back(point);
        }
        return halves;
    }

    /// The fraction of a box that is open to the sky.
    [[nodiscard]] double open_fraction(const WorldBox& box) const {
        const auto open = std::ranges::count_if(map_.open_points, [&](uint32_t point) {
            return contains(box, map_.lattice.at(point));
        });
        const glm::dvec3 size = box.size();
        return static_cast<double>(open) * map_.point_volume() / (size.x * size.y * size.z);
    }

    /// True if most of a room is outside of geometry and to be filled.
    [[nodiscard]] bool is_filled(const std::vector<uint32_t>& room) const {
        const size_t count = std::min(room.size(), kAskedPoints);
        size_t filled = 0;
        for (size_t i = 0; i < count; ++i) {
            const glm::dvec3 position = map_.lattice.at(room[i * room.size() / count]);
            filled +=
                is_free_with_clearance(traced_, position, rule_.clearance) && rule_.fills(position);
        }
        return 2 * filled > count;
    }

    [[nodiscard]] bool is_in_larger_room(const std::vector<uint32_t>& room) const {
        return std::ranges::any_of(boxes_, [&](const WorldBox& box) {
            const auto shared = std::ranges::count_if(
                room, [&](uint32_t point) { return contains(box, map_.lattice.at(point)); });
            return static_cast<double>(shared) > kSharedFraction * static_cast<double>(room.size());
        });
    }

    /// The free position nearest to the middle: the middle itself if a point of the room sees it.
    [[nodiscard]] std::optional<glm::dvec3> position_in(const std::vector<uint32_t>& room,
                                                        const glm::dvec3& middle) const {
        constexpr float kOfWidest = 0.6f;
        float widest = 0.0f;
        for (const uint32_t point : room) widest = std::max(widest, map_.distances[point]);
        const float clearance = std::min(static_cast<float>(kFarFromSurfaces), kOfWidest * widest);
        std::vector<std::pair<double, uint32_t>> points;
        for (const uint32_t point : room) {
            if (map_.distances[point] < clearance) continue;
            points.emplace_back(glm::distance(map_.lattice.at(point), middle), point);
        }
        std::ranges::sort(points);
        if (points.empty()) return std::nullopt;
        const auto [distance, nearest] = points.front();
        const bool is_seen = distance < map_.distances[nearest];
        if (is_seen && allows_reflection_probe(traced_, rule_, middle, clearance)) return middle;
        for (const auto& [away, point] : points) {
            const glm::dvec3 position = map_.lattice.at(point);
            if (allows_reflection_probe(traced_, rule_, position, clearance)) return position;
        }
        return std::nullopt;
    }

    const TraceScene& traced_;
    const ReflectionRule& rule_;
    RoomMap map_;
    std::vector<WorldBox> boxes_;  ///< of the rooms
    std::vector<ReflectionPlace> places_;
};

}  // namespace

std::vector<ReflectionPlace> place_reflections(const TraceScene& traced,
                                               const ReflectionRule& rule) {
    return ReflectionPlacer(traced, rule).run();
}

}  // namespace tetralight
