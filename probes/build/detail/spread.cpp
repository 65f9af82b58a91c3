// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/spread.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <utility>

#include <tetralight/probes/build/detail/snap_to_lattice.h>

namespace tetralight::detail {
namespace {

/// A few units in the last place: farther from a plane no rounding of its positions puts them.
constexpr double kRounding = 0x1p-49;

/// The position with the largest `measure`, and that measure.
template <class Measure>
std::pair<glm::dvec3, double> farthest(std::span<const glm::dvec3> positions, Measure measure) {
    std::pair<glm::dvec3, double> best{positions[0], -1.0};
    for (const glm::dvec3& position : positions) {
        const double value = measure(position);
        if (value > best.second) best = {position, value};
    }
    return best;
}

/// One of a direction and its opposite: the first component that counts is positive.
glm::dvec3 canonical_direction(const glm::dvec3& direction) {
    const glm::dvec3 unit = glm::normalize(direction);
    for (int i = 0; i < 3; ++i) {
        if (std::abs(unit[i]) > 1e-9) return unit[i] > 0 ? unit : -unit;
    }
    return unit;
}

/// A unit vector across a normal, near the axis that the normal is farthest from.
glm::dvec3 tangent_of(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
    glm::dvec3 tangent(0.0);
    tangent[axis] = 1.0;
    return glm::normalize(tangent - normal * normal[axis]);
}

}  // namespace

glm::dvec3 Spread::axis() const {
    if (dimension == Dimension::Line) return line;
    return dimension == Dimension::Plane ? normal : glm::dvec3(0.0);
}

Spread measure_spread(std::span<const glm::dvec3> positions, double flatness) {
    if (positions.empty()) return {};
    Spread spread{Dimension::Point};
    const glm::dvec3 first = *std::ranges::min_element(positions, [](const auto& a, const auto& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    });
    const auto [end, length] =
        farthest(positions, [&](const glm::dvec3& p) { return glm::distance(p, first); });
    if (length <= flatness) return spread;

    spread = {Dimension::Line, canonical_direction(end - first)};
    const double largest =
        farthest(positions, [](const glm::dvec3& p) { return glm::length(p); }).second;
    flatness = std::max(flatness, kRounding * largest);
    const auto [side, width] = farthest(positions, [&](const glm::dvec3& p) {
        return glm::length(glm::cross(p - first, spread.line));
    });
    if (width <= flatness) return spread;

    spread.dimension = Dimension::Plane;
    spread.normal = canonical_direction(glm::cross(spread.line, side - first));
    const double height = farthest(positions, [&](const glm::dvec3& p) {
                              return std::abs(glm::dot(p - first, spread.normal));
                          }).second;
    if (height > flatness) spread.dimension = Dimension::Space;
    return spread;
}

std::vector<uint32_t> order_along(std::span<const glm::dvec3> positions,
                                  const glm::dvec3& direction) {
    std::vector<uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {},
                      [&](uint32_t i) { return glm::dot(positions[i] - positions[0], direction); });
    return order;
}

std::vector<glm::dvec2> project(std::span<const glm::dvec3> positions, const glm::dvec3& normal) {
    const glm::dvec3 u = tangent_of(normal);
    const glm::dvec3 v = glm::cross(normal, u);
    std::vector<glm::dvec3> projected;
    projected.reserve(positions.size());
    for (const glm::dvec3& p : positions) {
        projected.emplace_back(glm::dot(p - positions[0], u), glm::dot(p - positions[0], v), 0.0);
    }
    // Rounding bends the straight lines of a turned lattice; this straightens them again.
    static_cast<void>(snap_to_lattice(projected));
    return {projected.begin(), projected.end()};
}

}  // namespace tetralight::detail
