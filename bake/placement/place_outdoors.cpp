// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/place_outdoors.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr int kOutdoorImportance = 1;
constexpr double kOutdoorHeight = 2.0;  // metres above the ground
/// A square with less free ground has no probe.
constexpr double kLeastGround = 0.05;

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

class OutdoorPlacer {
  public:
    OutdoorPlacer(const TraceScene& traced, const ReflectionRule& rule, const RoomMap& map,
                  std::span<const WorldBox> rooms)
        : traced_(traced), rule_(rule), map_(map), rooms_(rooms) {}

    [[nodiscard]] std::vector<ReflectionPlace> run() const {
        std::vector<ReflectionPlace> places;
        for (const auto& [number, square] : squares()) {
            const auto position = position_in(square);
            if (!position) continue;
            const WorldBox box = box_of(square, *position);
            places.push_back(make_reflection_place(*position, box, kOutdoorImportance));
            places.back().name = str_cat("outdoors ", places.size());
        }
        return places;
    }

  private:
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
    [[nodiscard]] std::map<std::pair<int, int>, Square> squares() const {
        std::map<std::pair<int, int>, Square> squares;
        for (const uint32_t point : map_.open_points) {
            const glm::dvec3 position = map_.lattice.at(point);
            const bool is_in_room = std::ranges::any_of(
                rooms_, [&](const WorldBox& box) { return contains(box, position); });
            if (is_in_room) continue;
            const int x = square_of(position, 0), z = square_of(position, 2);
            Square& square = squares[{z, x}];
            square.center = {middle_of(x, 0), middle_of(z, 2)};
            const glm::ivec3 layers = layers_of(map_.lattice, point);
            square.columns[{layers.z, layers.x}].points.push_back(point);
        }
        for (auto& [number, square] : squares) find_ground(square);
        std::erase_if(squares, [this](const auto& item) { return !has_ground(item.second); });
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

    /// The height below the lowest point of each column. Removes those with nothing below.
    void find_ground(Square& square) const {
        for (auto column = square.columns.begin(); column != square.columns.end();) {
            const glm::dvec3 lowest = map_.lattice.at(column->second.points.front());
            const auto floor =
                traced_.nearest_crossing({traced_.render_from_world(lowest), glm::vec3(0, -1, 0)});
            if (floor) column->second.ground = lowest.y - floor->distance;
            column = floor ? std::next(column) : square.columns.erase(column);
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
        // Higher ground is mostly roofs.
        const glm::dvec3 middle(square.center.x, ground_of(square, 0.75), square.center.y);
        std::vector<std::pair<double, const Column*>> columns;
        for (const auto& [number, column] : square.columns) {
            glm::dvec3 place = map_.lattice.at(column.points.front());
            place.y = column.ground;
            columns.emplace_back(glm::distance(place, middle), &column);
        }
        std::ranges::stable_sort(columns, {}, [](const auto& item) { return item.first; });
        for (const double clearance : {kFarFromSurfaces, rule_.clearance}) {
            for (const auto& [away, column] : columns) {
                const glm::dvec3 position = position_above(*column);
                if (allows_reflection_probe(traced_, rule_, position, clearance) &&
                    rule_.fills(position))
                    return position;
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
        const glm::dvec2 half = 0.5 * glm::dvec2(square_side(0), square_side(2));
        box.min.x = square.center.x - half.x;
        box.max.x = square.center.x + half.x;
        box.min.z = square.center.y - half.y;
        box.max.z = square.center.y + half.y;
        return box;
    }

    const TraceScene& traced_;
    const ReflectionRule& rule_;
    const RoomMap& map_;
    std::span<const WorldBox> rooms_;
};

}  // namespace

std::vector<ReflectionPlace> place_outdoors(const TraceScene& traced, const ReflectionRule& rule,
                                            const RoomMap& map, std::span<const WorldBox> rooms) {
    return OutdoorPlacer(traced, rule, map, rooms).run();
}

}  // namespace tetralight
