// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/smallest_rectangle.h>

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

#include <tetralight/base/box.h>
#include <tetralight/charts/detail/flat_triangle.h>

namespace tetralight::detail {

namespace {

/// Appends the part of the hull that lies to the right of the way along sorted points.
template <class Points>
void append_chain(const Points& points, std::vector<glm::dvec2>& hull) {
    const size_t begin = hull.size();
    for (const glm::dvec2 point : points) {
        while (hull.size() >= begin + 2 &&
               twice_signed_area(hull[hull.size() - 2], hull.back(), point) <= 0.0) {
            hull.pop_back();
        }
        hull.push_back(point);
    }
    hull.pop_back();  // the first of the other chain
}

/// Corners of the convex hull, counterclockwise (Andrew 1979).
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
    std::ranges::sort(points, {}, [](glm::dvec2 p) { return std::tuple(p.x, p.y); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 2) return points;
    std::vector<glm::dvec2> hull;
    append_chain(points, hull);
    std::ranges::reverse(points);
    append_chain(points, hull);
    return hull;
}

double rectangle_area(const std::vector<glm::dvec2>& hull, glm::dvec2 side) {
    Box<glm::dvec2> box = Box<glm::dvec2>::empty();
    for (const glm::dvec2 p : hull) {
        box = union_of(box, glm::dvec2(glm::dot(side, p), side.x * p.y - side.y * p.x));
    }
    return box.size().x * box.size().y;
}

}  // namespace

glm::dvec2 smallest_rectangle_side(std::vector<glm::dvec2> points) {
    constexpr size_t kMostSides = 64;
    constexpr double kBetter = 1.0 - 1e-9;  // rounding does not decide between equal rectangles
    const std::vector<glm::dvec2> hull = convex_hull(std::move(points));
    std::vector<glm::dvec2> sides;
    for (size_t i = 0; i < hull.size(); ++i) {
        sides.push_back(hull[(i + 1) % hull.size()] - hull[i]);
    }
    std::ranges::stable_sort(sides, std::greater<>(),
                             [](glm::dvec2 side) { return glm::dot(side, side); });
    if (sides.size() > kMostSides) sides.resize(kMostSides);
    glm::dvec2 best_side(1.0, 0.0);
    double best_area = std::numeric_limits<double>::infinity();
    for (const glm::dvec2 side : sides) {
        if (!(glm::dot(side, side) > 0.0)) continue;
        const glm::dvec2 direction = glm::normalize(side);
        const double area = rectangle_area(hull, direction);
        if (!(area < best_area * kBetter)) continue;
        best_area = area;
        best_side = direction;
    }
    return best_side;
}

}  // namespace tetralight::detail
