// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/place_reflections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/room_box.h>
#include <tetralight/bake/placement/rooms.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr int kRoomImportance = 2, kOutdoorImportance = 1;
constexpr double kBlendFraction = 0.1;  // of the smallest side
/// Sides of a room, of six, that must be walls.
constexpr int kLeastWalls = 4;
constexpr double kLeastSide = 0.8;  // of a room, metres
/// A room whose box is open to the sky in a larger part is split.
constexpr double kOpenFraction = 0.15;
/// Of a room's points: inside the box of a larger room, it has no probe.
constexpr double kSharedFraction = 0.8;
/// Distance of probes from surfaces, metres, where the room is wide enough.
constexpr float kFarFromSurfaces = 0.5f;
constexpr double kOutdoorHeight = 2.0;  // metres above the ground
/// A square with less free ground has no probe.
constexpr double kLeastGround = 0.05;
/// Points of a room that decide whether it is to be filled.
constexpr size_t kAskedPoints = 16;

ReflectionPlace make_place(const glm::dvec3& position, const WorldBox& box, int importance) {
    const glm::dvec3 size = box.size();
    ReflectionPlace place;
    place.position = position;
    place.box_center = glm::vec3(box.center() - position);
    place.half_size = glm::vec3(0.5 * size);
    place.blend_distance = static_cast<float>(kBlendFraction * std::min({size.x, size.y, size.z}));
    place.importance = importance;
    return place;
}

/// The free points of one column of the lattice, from the ground up.
struct Column {
    double ground = 0.0;
    std::vector<uint32_t> points;
};

/// A square of the ground.
struct Square {
    glm::dvec2 center{0.0};
    std::map<std::pair<int, int>, Column> columns;
};

class ReflectionPlacer {
  public:
    ReflectionPlacer(const TraceScene& traced, const ReflectionRule& rule)
        : traced_(traced),
          rule_(rule),
          map_(find_rooms(traced, {rule.bounds, rule.clearance, rule.thread_count})) {}

    std::vector<ReflectionPlace> run() {
        place_rooms();
        place_outdoors();
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

    /// One probe, or several in an arcade around a court, which no box is to hold.
    void place_room(const std::vector<uint32_t>& room, const WorldBox& box, int depth) {
        constexpr int kMostSplits = 3;
        if (depth < kMostSplits && open_fraction(box) > kOpenFraction) {
            const glm::dvec3 size = box.size();
            const int axis = size.x >= size.z ? 0 : 2;
            std::array<std::vector<uint32_t>, 2> halves;
            for (const uint32_t point : room) {
                halves[map_.lattice.at(point)[axis] < box.center()[axis] ? 0 : 1].push_back(point);
            }
            for (const auto& half : halves) {
                if (half.empty()) continue;
                place_room(half, fit(half).fitted.box, depth + 1);
            }
            return;
        }
        const glm::dvec3 size = box.size();
        if (std::min({size.x, size.y, size.z}) < kLeastSide || is_in_larger_room(room)) return;
        boxes_.push_back(box);
        const auto position = position_in(room, box.center());
        if (!position) return;
        places_.push_back(make_place(*position, box, kRoomImportance));
        places_.back().name = str_cat("room ", places_.size());
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
                is_free_with_clearance(traced_, position, rule_.clearance) && is_filled(position);
        }
        return 2 * filled > count;
    }

    [[nodiscard]] bool is_filled(const glm::dvec3& position) const {
        return !rule_.is_filled || rule_.is_filled(position);
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
        const float clearance = std::min(kFarFromSurfaces, kOfWidest * widest);
        std::vector<std::pair<double, uint32_t>> points;
        for (const uint32_t point : room) {
            if (map_.distances[point] < clearance) continue;
            points.emplace_back(glm::distance(map_.lattice.at(point), middle), point);
        }
        std::ranges::sort(points);
        if (points.empty()) return std::nullopt;
        const auto [distance, nearest] = points.front();
        const bool is_seen = distance < map_.distances[nearest];
        if (is_seen && is_allowed(middle, clearance)) return middle;
        for (const auto& [away, point] : points) {
            const glm::dvec3 position = map_.lattice.at(point);
            if (is_allowed(position, clearance)) return position;
        }
        return std::nullopt;
    }

    [[nodiscard]] bool is_allowed(const glm::dvec3& position, double clearance) const {
        return !adjustment_at(rule_.adjustments, position).forbids_probes &&
               is_free_with_clearance(traced_, position, clearance);
    }

    void place_outdoors() {
        // A scene without surfaces has nothing to reflect.
        if (traced_.geometry_count() == 0) return;
        const size_t room_count = places_.size();
        for (const auto& [number, square] : squares()) {
            const auto position = position_in(square);
            if (!position) continue;
            const WorldBox box = box_of(square, *position);
            places_.push_back(make_place(*position, box, kOutdoorImportance));
            places_.back().name = str_cat("outdoors ", places_.size() - room_count);
        }
    }

    /// How many squares the bounds have along an axis.
    [[nodiscard]] double square_count(int axis) const {
        constexpr double kRounding = 1e-6;
        const double side = std::max(rule_.spacing, map_.lattice.axes[axis].spacing);
        return std::max(1.0, std::ceil(rule_.bounds.size()[axis] / side - kRounding));
    }

    [[nodiscard]] double square_side(int axis) const {
        return rule_.bounds.size()[axis] / square_count(axis);
    }

    /// The squares with open ground outside of the rooms, row by row.
    [[nodiscard]] std::map<std::pair<int, int>, Square> squares() {
        std::map<std::pair<int, int>, Square> squares;
        for (const uint32_t point : map_.open_points) {
            const glm::dvec3 position = map_.lattice.at(point);
            const bool is_in_room = std::ranges::any_of(
                boxes_, [&](const WorldBox& box) { return contains(box, position); });
            if (is_in_room) continue;
            const int x = square_of(position, 0), z = square_of(position, 2);
            Square& square = squares[{z, x}];
            square.center = {middle_of(x, 0), middle_of(z, 2)};
            const glm::ivec3 layers = layers_of(map_.lattice, point);
            square.columns[{layers.z, layers.x}].points.push_back(point);
        }
        std::erase_if(squares, [this](const auto& item) { return !has_ground(item.second); });
        for (auto& [number, square] : squares) find_ground(square);
        return squares;
    }

    [[nodiscard]] int square_of(const glm::dvec3& position, int axis) const {
        const double side = square_side(axis);
        if (!(side > 0.0)) return 0;
        const double number = std::floor((position[axis] - rule_.bounds.min[axis]) / side);
        return static_cast<int>(std::clamp(number, 0.0, square_count(axis) - 1.0));
    }

    [[nodiscard]] double middle_of(int number, int axis) const {
        return rule_.bounds.min[axis] + (number + 0.5) * square_side(axis);
    }

    [[nodiscard]] bool has_ground(const Square& square) const {
        const double of_column = map_.lattice.axes[0].spacing * map_.lattice.axes[2].spacing;
        return static_cast<double>(square.columns.size()) * of_column >=
               kLeastGround * square_side(0) * square_side(2);
    }

    /// The height below the lowest point of each column; where nothing is below, of the bounds.
    void find_ground(Square& square) const {
        for (auto& [number, column] : square.columns) {
            const glm::dvec3 lowest = map_.lattice.at(column.points.front());
            const auto floor =
                traced_.nearest_crossing({traced_.render_from_world(lowest), glm::vec3(0, -1, 0)});
            column.ground = floor ? lowest.y - floor->distance : rule_.bounds.min.y;
        }
    }

    /// The height above which this fraction of the ground is.
    [[nodiscard]] static double ground_of(const Square& square, double fraction) {
        std::vector<double> heights;
        for (const auto& [number, column] : square.columns) heights.push_back(column.ground);
        std::ranges::sort(heights, std::greater{});
        return heights[static_cast<size_t>(fraction * static_cast<double>(heights.size() - 1))];
    }

    /// Above the ground nearest to the middle of a square where there is room.
    [[nodiscard]] std::optional<glm::dvec3> position_in(const Square& square) const {
        // Most of what is higher are roofs.
        const glm::dvec3 middle(square.center.x, ground_of(square, 0.75), square.center.y);
        std::vector<std::pair<double, const Column*>> columns;
        for (const auto& [number, column] : square.columns) {
            glm::dvec3 place = map_.lattice.at(column.points.front());
            place.y = column.ground;
            columns.emplace_back(glm::distance(place, middle), &column);
        }
        std::ranges::stable_sort(columns, {}, [](const auto& item) { return item.first; });
        for (const double clearance : {static_cast<double>(kFarFromSurfaces), rule_.clearance}) {
            for (const auto& [away, column] : columns) {
                const glm::dvec3 position = position_above(*column);
                if (is_allowed(position, clearance) && is_filled(position)) return position;
            }
        }
        return std::nullopt;
    }

    /// The point of a column whose height above the ground is nearest to that of probes.
    [[nodiscard]] glm::dvec3 position_above(const Column& column) const {
        const double height = column.ground + kOutdoorHeight;
        return map_.lattice.at(*std::ranges::min_element(column.points, {}, [&](uint32_t point) {
            return std::abs(map_.lattice.at(point).y - height);
        }));
    }

    /// From the lowest ground, except for holes, to the top of the bounds.
    [[nodiscard]] WorldBox box_of(const Square& square, const glm::dvec3& position) const {
        WorldBox box;
        box.min.y = ground_of(square, 0.95);
        box.max.y = std::max(rule_.bounds.max.y, position.y + kOutdoorHeight);
        // Wider by the blend distance, a tenth of the box, than the square.
        const glm::dvec2 half = 0.5 * glm::dvec2(square_side(0), square_side(2));
        const double smallest =
            std::min({half.x, half.y, 0.5 * (1.0 - kBlendFraction) * (box.max.y - box.min.y)});
        const double more = kBlendFraction / (1.0 - kBlendFraction) * smallest;
        box.min.x = square.center.x - half.x - more;
        box.max.x = square.center.x + half.x + more;
        box.min.z = square.center.y - half.y - more;
        box.max.z = square.center.y + half.y + more;
        return box;
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
