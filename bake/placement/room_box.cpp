// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/room_box.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

namespace tetralight {
namespace {

/// The fraction of a side's rays that makes a wall, and how far apart they may hit it, metres.
constexpr double kWallFraction = 0.25, kWallDepth = 0.05;
/// A side with more walls than this is a wall.
constexpr double kClosedFraction = 0.5;
/// The fraction of rows that a side without walls leaves out at its outer end.
constexpr double kStrayFraction = 0.05;

size_t fraction_of(size_t count, double fraction) {
    return static_cast<size_t>(fraction * static_cast<double>(count));
}

/// One of the six sides of a room.
struct Side {
    int axis = 0;
    int sign = 1;

    /// Larger for what is farther out.
    [[nodiscard]] double outward(double coordinate) const { return sign * coordinate; }
};

/// The last point of each row of a room towards a side.
std::vector<uint32_t> last_points(const RoomMap& map, const std::vector<uint32_t>& room,
                                  const Side& side) {
    std::map<std::pair<int, int>, std::pair<int, uint32_t>> last;
    for (const uint32_t point : room) {
        const glm::ivec3 layers = layers_of(map.lattice, point);
        const std::pair row(layers[(side.axis + 1) % 3], layers[(side.axis + 2) % 3]);
        const std::pair candidate(side.sign * layers[side.axis], point);
        const auto [found, is_new] = last.try_emplace(row, candidate);
        if (!is_new) found->second = std::max(found->second, candidate);
    }
    std::vector<uint32_t> points;
    for (const auto& [row, farthest] : last) points.push_back(farthest.second);
    return points;
}

/// Where rays hit the walls of a side, outward, the outermost first.
std::vector<double> wall_hits(const TraceScene& traced, const RoomMap& map,
                              const std::vector<uint32_t>& points, const Side& side,
                              double clearance) {
    // A row ends at a wall if the next point would be nearer to it than the clearance.
    const double reach = clearance + 1.5 * map.lattice.axes[side.axis].spacing;
    glm::vec3 direction(0.0f);
    direction[side.axis] = static_cast<float>(side.sign);
    std::vector<double> hits;
    for (const uint32_t point : points) {
        const glm::dvec3 position = map.lattice.at(point);
        const auto wall = traced.nearest_crossing(
            {traced.render_from_world(position), direction, static_cast<float>(reach)});
        if (wall) hits.push_back(side.outward(position[side.axis]) + wall->distance);
    }
    std::ranges::sort(hits, std::greater{});
    return hits;
}

/// The outermost wall that enough rays hit, if there is one.
std::optional<double> outermost_wall(const std::vector<double>& hits) {
    const size_t enough = std::max<size_t>(1, fraction_of(hits.size(), kWallFraction));
    for (size_t first = 0; first + enough <= hits.size(); ++first) {
        if (hits[first] - hits[first + enough - 1] > kWallDepth) continue;
        const auto end = std::find_if(hits.begin() + static_cast<std::ptrdiff_t>(first), hits.end(),
                                      [&](double hit) { return hits[first] - hit > kWallDepth; });
        const auto count = static_cast<size_t>(end - hits.begin()) - first;
        return hits[first + count / 2];
    }
    return std::nullopt;
}

/// Where a side that is open for the most part ends, outward.
double open_end(const RoomMap& map, const std::vector<uint32_t>& points, const Side& side) {
    std::vector<double> ends;
    for (const uint32_t point : points) {
        ends.push_back(side.outward(map.lattice.at(point)[side.axis]));
    }
    std::ranges::sort(ends, std::greater{});
    return ends[fraction_of(ends.size(), kStrayFraction)] +
           0.5 * map.lattice.axes[side.axis].spacing;
}

/// The length that two boxes have in common along an axis, relative to the longer one.
double shared_fraction(const WorldBox& a, const WorldBox& b, int axis) {
    const double shared = std::min(a.max[axis], b.max[axis]) - std::max(a.min[axis], b.min[axis]);
    return shared / std::max(a.size()[axis], b.size()[axis]);
}

}  // namespace

bool are_parts_of_one_room(const RoomBox& a, const RoomBox& b, double gap) {
    constexpr double kSameSide = 0.8;
    for (int axis = 0; axis < 3; ++axis) {
        const bool is_a_below = a.is_max_open[axis] && b.is_min_open[axis] &&
                                std::abs(a.box.max[axis] - b.box.min[axis]) <= gap;
        const bool is_b_below = b.is_max_open[axis] && a.is_min_open[axis] &&
                                std::abs(b.box.max[axis] - a.box.min[axis]) <= gap;
        const double same = shared_fraction(a.box, b.box, (axis + 1) % 3) *
                            shared_fraction(a.box, b.box, (axis + 2) % 3);
        if ((is_a_below || is_b_below) && same >= kSameSide) return true;
    }
    return false;
}

RoomBox fit_room_box(const TraceScene& traced, const RoomMap& map,
                     const std::vector<uint32_t>& room, double clearance) {
    RoomBox fitted;
    for (int axis = 0; axis < 3; ++axis) {
        for (const int sign : {-1, 1}) {
            const Side side{axis, sign};
            const std::vector<uint32_t> points = last_points(map, room, side);
            const std::vector<double> hits = wall_hits(traced, map, points, side, clearance);
            fitted.wall_count += hits.size() > fraction_of(points.size(), kClosedFraction);
            const bool is_open = hits.size() <= fraction_of(points.size(), kWallFraction);
            (sign < 0 ? fitted.is_min_open : fitted.is_max_open)[axis] = is_open;
            // A dome or a sloped roof has no place that many rays hit.
            const double outward =
                is_open
                    ? open_end(map, points, side)
                    : outermost_wall(hits).value_or(hits[fraction_of(hits.size(), kWallFraction)]);
            (sign < 0 ? fitted.box.min : fitted.box.max)[axis] = sign * outward;
        }
    }
    return fitted;
}

}  // namespace tetralight
