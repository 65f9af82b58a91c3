// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/hull_cell.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

namespace tetralight::detail {
namespace {

/// More than rounding makes of a cubic whose lengths are of order 1.
constexpr double kRisen = 1e-12;

/// c[0] + c[1] t + c[2] t² + c[3] t³.
using Cubic = std::array<double, 4>;

double determinant(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::dot(glm::cross(a, b), c);
}

double evaluate(const Cubic& c, double t) {
    return ((c[3] * t + c[2]) * t + c[1]) * t + c[0];
}

double derivative(const Cubic& c, double t) {
    return (3 * c[3] * t + 2 * c[2]) * t + c[1];
}

/// The t > 0 where the slope is zero, ascending; unused places are 0. Stable quadratic formula.
std::array<double, 2> extrema(const Cubic& c) {
    const double a = 3 * c[3];
    const double b = 2 * c[2];
    const double discriminant = b * b - 4 * a * c[1];
    if (discriminant < 0) return {0, 0};
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    const auto positive = [](double root) { return std::isfinite(root) && root > 0 ? root : 0.0; };
    std::array<double, 2> roots{positive(q / a), positive(c[1] / q)};
    if (roots[0] > roots[1]) std::swap(roots[0], roots[1]);
    return roots;
}

/// The root in [low, high], where the cubic goes from positive to not positive: Newton's steps, or
/// halving where they leave the bracket.
double bracketed_root(const Cubic& c, double low, double high) {
    double t = 0.5 * (low + high);
    for (int step = 0; step < 100; ++step) {
        const double value = evaluate(c, t);
        (value > 0 ? low : high) = t;
        const double newton = t - value / derivative(c, t);
        const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (std::abs(next - t) <= 1e-15 * high) return next;
        t = next;
    }
    return t;
}

/// The root of a cubic that is positive at 0 and whose other coefficients are ≤ 0, the first of
/// them negative. It falls ever faster, so that its root lies before that of its first three terms,
/// and Newton's steps come down to it from there: the last one doubles the digits that are right.
double root_of_falling(const Cubic& c) {
    double t = 2 * c[0] / (std::sqrt(c[1] * c[1] - 4 * c[2] * c[0]) - c[1]);
    for (int step = 0; step < 100; ++step) {
        const double next = t - evaluate(c, t) / derivative(c, t);
        if (!(next < t * (1 - 1e-8))) return next;
        t = next;
    }
    return t;
}

/// Smallest t ≥ 0 where the cubic, positive at 0, is no longer positive. Lengths are of order 1, so
/// that a surface farther than 2^20 belongs to another cell.
std::optional<double> first_root(const Cubic& c) {
    if (c[1] < 0 && c[2] <= 0 && c[3] <= 0) {
        const double root = root_of_falling(c);
        return root <= kFarthestRoot ? std::optional(root) : std::nullopt;
    }
    double low = 0;
    for (const double extremum : extrema(c)) {
        if (extremum <= low) continue;
        if (evaluate(c, extremum) <= 0) return bracketed_root(c, low, extremum);
        low = extremum;
    }
    for (double high = std::max(1.0, 2 * low); high <= kFarthestRoot; high *= 2) {
        if (evaluate(c, high) <= 0) return bracketed_root(c, low, high);
    }
    return std::nullopt;
}

/// Edges A, B of a triangle and the way D from its third corner to the query; how they change with
/// t: A + tA', B + tB', D − t v2.
struct MovingTriangle {
    HullTriangle at;
    glm::dvec3 first_rate, second_rate, third_ray;

    [[nodiscard]] HullTriangle after(double t) const {
        return {at.first + t * first_rate, at.second + t * second_rate,
                at.to_query - t * third_ray};
    }
};

/// det[A + tA', B + tB', D − t v2] as a cubic in t.
Cubic plane_cubic(const MovingTriangle& triangle) {
    const auto& [a, b, d] = triangle.at;
    const glm::dvec3& da = triangle.first_rate;
    const glm::dvec3& db = triangle.second_rate;
    const glm::dvec3& v2 = triangle.third_ray;
    // The normal of the moved triangle: n0 + n1 t + n2 t².
    const glm::dvec3 n0 = glm::cross(a, b);
    const glm::dvec3 n1 = glm::cross(a, db) + glm::cross(da, b);
    const glm::dvec3 n2 = glm::cross(da, db);
    return {glm::dot(n0, d), glm::dot(n1, d) - glm::dot(n0, v2), glm::dot(n2, d) - glm::dot(n1, v2),
            -glm::dot(n2, v2)};
}

std::optional<glm::dvec3> weights_of_query(const HullTriangle& triangle) {
    const auto& [first, second, to_query] = triangle;
    const glm::dvec3 normal = glm::cross(first, second);
    const double area = glm::dot(normal, normal);
    const double longest = std::max(glm::dot(first, first), glm::dot(second, second));
    if (!(area > kFlatTriangle * longest * longest)) return std::nullopt;
    const double unit = 1 / area;
    const double w0 = glm::dot(glm::cross(to_query, second), normal) * unit;
    const double w1 = glm::dot(glm::cross(first, to_query), normal) * unit;
    return glm::dvec3(w0, w1, 1 - w0 - w1);
}

/// Where a cubic that is not positive at 0 falls to zero after it has risen above it. A hull
/// triangle that is thinner than steps of its float positions may face inwards, or have no area,
/// and turn outwards as it grows.
std::optional<double> crossing_after_rise(const Cubic& cubic) {
    const double top = extrema(cubic)[1];
    if (!(evaluate(cubic, top) > kRisen)) return std::nullopt;
    double high = std::max(1.0, 2 * top);
    while (high <= kFarthestRoot && evaluate(cubic, high) > 0) high *= 2;
    return high <= kFarthestRoot ? std::optional(bracketed_root(cubic, top, high)) : std::nullopt;
}

/// The first t ≥ 0 where the cubic is zero; none where it is negative from the beginning.
std::optional<double> first_crossing(const Cubic& cubic) {
    if (cubic[0] > 0) return first_root(cubic);
    return cubic[0] == 0 ? std::optional(0.0) : crossing_after_rise(cubic);
}

/// Length of the longest vector; none if it is 0 or not finite.
std::optional<double> length_scale(std::span<const glm::dvec3> vectors) {
    double scale = 0;
    for (const glm::dvec3& v : vectors) scale = std::max(scale, glm::dot(v, v));
    if (!(scale > 0) || !std::isfinite(scale)) return std::nullopt;
    return std::sqrt(scale);
}

}  // namespace

std::optional<glm::dvec3> hull_cell_weights(const HullTriangle& triangle,
                                            const HullCellRays& rays) noexcept {
    const auto scale = length_scale(std::array{triangle.first, triangle.second, triangle.to_query});
    if (!scale) return std::nullopt;
    const double unit = 1 / *scale;
    const glm::dvec3 third(rays.rays[2]);
    const MovingTriangle moving{
        {triangle.first * unit, triangle.second * unit, triangle.to_query * unit},
        glm::dvec3(rays.rays[0]) - third,
        glm::dvec3(rays.rays[1]) - third,
        third};
    const Cubic cubic = plane_cubic(moving);
    std::optional<double> t = first_crossing(cubic);
    if (t == 0.0) {
        const auto weights = weights_of_query(moving.at);
        if (weights) return weights;
        t = crossing_after_rise(cubic);  // the corners are collinear
    }
    return t ? weights_of_query(moving.after(*t)) : std::nullopt;
}

std::optional<glm::dvec2> hull_edge_weights(const std::array<glm::dvec3, 2>& corners,
                                            const HullCellRays& rays,
                                            const glm::dvec3& axis) noexcept {
    const auto scale = length_scale(corners);
    if (!scale) return std::nullopt;
    std::array<glm::dvec3, 2> p;
    std::array<glm::dvec3, 2> v;
    for (int i = 0; i < 2; ++i) {
        p[i] = corners[i] / *scale;
        v[i] = glm::dvec3(rays.rays[i]);
    }
    // The origin lies outside the edge while det[p0 + t v0, p1 + t v1, axis] is negative.
    const Cubic cubic{-determinant(p[0], p[1], axis),
                      -determinant(v[0], p[1], axis) - determinant(p[0], v[1], axis),
                      -determinant(v[0], v[1], axis), 0.0};
    const std::optional<double> t = first_crossing(cubic);
    if (!t) return std::nullopt;
    const glm::dvec3 a = p[0] + *t * v[0];
    const glm::dvec3 edge = p[1] + *t * v[1] - a;
    const glm::dvec3 across =
        glm::cross(axis, glm::cross(edge, axis));  // the edge seen along the axis
    const double length = glm::dot(across, edge);
    if (!(length > 0)) return std::nullopt;
    const double weight = -glm::dot(across, a) / length;
    return glm::dvec2(1 - weight, weight);
}

}  // namespace tetralight::detail
