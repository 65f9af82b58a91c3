// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/reach_walls.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

/// Relative to the clearance: how far a position exceeds it, and the tolerance for rounding.
constexpr double kSlack = 1e-3;

class Reach {
  public:
    Reach(const TraceScene& traced, const ReachRule& rule) : traced_(traced), rule_(rule) {}

    /// Appends the positions that stand for one along an axis.
    void along(int axis, double spacing, const glm::dvec3& position,
               std::vector<glm::dvec3>& found) const {
        // Walls this near have no room for a layer of their own; a gap of this width has one layer.
        constexpr double kAtWall = 0.01, kNarrow = 0.1;
        // Layers are half a spacing from the sides of the bounds, up to rounding.
        constexpr double kHalf = 0.501;
        const auto down = way(position, axis, -1.0, spacing);
        const auto up = way(position, axis, 1.0, spacing);
        const bool is_narrow = down && up && *down + *up < kNarrow * spacing;
        bool is_taken = false;
        for (const auto& [length, sign] : {std::pair{down, -1.0}, std::pair{up, 1.0}}) {
            if (is_narrow || !length || *length < kAtWall * spacing) continue;
            glm::dvec3 place = position;
            place[axis] += sign * *length;
            found.push_back(place);
            is_taken = is_taken || *length <= kHalf * spacing;
        }
        // At one wall already: the position is its layer.
        const bool is_at_wall =
            (down && *down < kAtWall * spacing) || (up && *up < kAtWall * spacing);
        if (!is_taken || is_narrow || is_at_wall) found.push_back(position);
    }

  private:
    /// Metres to the layer at the next wall or side of the bounds; none if it is a spacing away.
    [[nodiscard]] std::optional<double> way(const glm::dvec3& position, int axis, double sign,
                                            double spacing) const {
        glm::vec3 direction(0.0f);
        direction[axis] = static_cast<float>(sign);
        const glm::vec3 from = traced_.render_from_world(position);
        const double side = sign < 0.0 ? position[axis] - rule_.bounds.min[axis]
                                       : rule_.bounds.max[axis] - position[axis];
        double end = std::max(side, 0.0);
        const double reach = spacing + rule_.clearance;
        const auto hit = traced_.intersect_side({from, direction, static_cast<float>(reach)});
        if (hit) end = std::min(end, double{hit->distance});
        bool is_found = end < reach;
        if (rule_.holds) {
            const double border = border_along(position, axis, sign, std::min(end, spacing));
            is_found = is_found || border < std::min(end, spacing);
            end = std::min(end, border);
        }
        if (!is_found) return std::nullopt;
        const double length = with_clearance(from, direction, end);
        if (length >= spacing) return std::nullopt;
        return length;
    }

    /// How far probes may be, at most `end`; by bisection.
    [[nodiscard]] double border_along(const glm::dvec3& position, int axis, double sign,
                                      double end) const {
        constexpr int kSteps = 12;
        const auto holds = [&](double length) {
            glm::dvec3 place = position;
            place[axis] += sign * length;
            return rule_.holds(place);
        };
        // Rounding may put the end itself outside.
        double low = 0.0, high = (1.0 - kSlack) * end;
        if (holds(high)) return end;
        for (int i = 0; i < kSteps; ++i) {
            const double middle = 0.5 * (low + high);
            (holds(middle) ? low : high) = middle;
        }
        return low;
    }

    /// The largest length up to `end` at which the way has clearance; 0 if there is none.
    [[nodiscard]] double with_clearance(glm::vec3 from, glm::vec3 direction, double end) const {
        constexpr int kMaxSteps = 32;
        double length = end;
        for (int i = 0; i < kMaxSteps && length > 0.0; ++i) {
            const glm::vec3 place = from + static_cast<float>(length) * direction;
            const auto nearest = traced_.nearest_surface(place);
            if (!nearest) return length;
            const double room = glm::distance(place, *nearest);
            if (room >= rule_.clearance) return length;
            // No farther place has clearance: the distance changes no faster than the length.
            length -= (1.0 + kSlack) * rule_.clearance - room;
        }
        return 0.0;
    }

    const TraceScene& traced_;
    const ReachRule& rule_;
};

/// A coordinate and how many positions have it.
struct Plane {
    double coordinate = 0.0;
    size_t count = 0;
};

std::vector<Plane> planes_along(const std::vector<glm::dvec3>& positions, int axis) {
    std::vector<double> coordinates;
    coordinates.reserve(positions.size());
    for (const glm::dvec3& position : positions) coordinates.push_back(position[axis]);
    std::ranges::sort(coordinates);
    std::vector<Plane> planes;
    for (const double coordinate : coordinates) {
        if (planes.empty() || planes.back().coordinate != coordinate)
            planes.push_back({coordinate, 0});
        ++planes.back().count;
    }
    return planes;
}

}  // namespace

std::vector<glm::dvec3> reach_walls(const TraceScene& traced, const glm::dvec3& position,
                                    const glm::dvec3& spacing, const ReachRule& rule) {
    const Reach reach(traced, rule);
    std::vector<glm::dvec3> positions{position};
    for (const int axis : {1, 0, 2}) {
        if (!rule.axes[axis]) continue;
        std::vector<glm::dvec3> found;
        for (const glm::dvec3& place : positions) reach.along(axis, spacing[axis], place, found);
        positions = std::move(found);
    }
    return positions;
}

void align_planes(std::vector<glm::dvec3>& positions, double tolerance) {
    TETRALIGHT_ASSERT(tolerance > 0.0, "a positive tolerance");
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<Plane> planes = planes_along(positions, axis);
        std::vector<double> targets(planes.size());
        for (size_t begin = 0; begin < planes.size();) {
            size_t end = begin, best = begin;
            for (; end < planes.size() &&
                   planes[end].coordinate - planes[begin].coordinate < tolerance;
                 ++end) {
                if (planes[end].count > planes[best].count) best = end;
            }
            std::fill(targets.begin() + static_cast<std::ptrdiff_t>(begin),
                      targets.begin() + static_cast<std::ptrdiff_t>(end), planes[best].coordinate);
            begin = end;
        }
        for (glm::dvec3& position : positions) {
            const auto plane =
                std::ranges::lower_bound(planes, position[axis], {}, &Plane::coordinate);
            position[axis] = targets[static_cast<size_t>(plane - planes.begin())];
        }
    }
}

}  // namespace tetralight
