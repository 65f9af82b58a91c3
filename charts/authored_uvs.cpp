// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/authored_uvs.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <tetralight/base/box.h>
#include <tetralight/base/contract.h>
#include <tetralight/charts/detail/coverage_grid.h>
#include <tetralight/charts/detail/flat_triangle.h>

namespace tetralight {

namespace {

using detail::FlatTriangle;
using UvBox = Box<glm::dvec2>;

FlatTriangle uv_triangle(const ChartMesh& mesh, std::span<const glm::vec2> uvs, size_t triangle) {
    const auto corner = [&](size_t k) { return glm::dvec2(uvs[mesh.indices[3 * triangle + k]]); };
    return {corner(0), corner(1), corner(2)};
}

double uv_area(const FlatTriangle& triangle) {
    return 0.5 * std::abs(detail::twice_signed_area(triangle[0], triangle[1], triangle[2]));
}

double surface_area(const ChartMesh& mesh, size_t triangle) {
    const auto corner = [&](size_t k) {
        return glm::dvec3(mesh.positions[mesh.indices[3 * triangle + k]]);
    };
    return 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
}

bool is_finite(glm::dvec2 uv) {
    return std::isfinite(uv.x) && std::isfinite(uv.y);
}

bool is_outside(glm::dvec2 uv) {
    constexpr double kTolerance = 1e-4;
    const UvBox allowed{glm::dvec2(-kTolerance), glm::dvec2(1.0 + kTolerance)};
    return !contains(allowed, uv);
}

UvBox bounds_of(std::span<const FlatTriangle> triangles) {
    UvBox bounds = UvBox::empty();
    for (const FlatTriangle& triangle : triangles) {
        for (const glm::dvec2 corner : triangle) bounds = union_of(bounds, corner);
    }
    return bounds;
}

double overlap_area(std::span<const FlatTriangle> triangles) {
    const UvBox bounds = bounds_of(triangles);
    if (!glm::all(glm::lessThan(bounds.min, bounds.max))) return 0.0;
    detail::CoverageGrid grid(bounds);
    for (const FlatTriangle& triangle : triangles) grid.add(triangle);
    return grid.overlap_area();
}

/// Of a triangle or a mesh.
struct Areas {
    double uv = 0.0;
    double surface = 0.0;
};

double lost_fraction(std::span<const Areas> triangles, const Areas& total) {
    constexpr double kLeastShare = 1e-6;
    if (!(total.surface > 0.0)) return 0.0;
    double lost = 0.0;
    for (const Areas& triangle : triangles) {
        const bool is_lost = !(total.uv > 0.0) || triangle.uv * total.surface <
                                                      kLeastShare * triangle.surface * total.uv;
        if (is_lost) lost += triangle.surface;
    }
    return lost / total.surface;
}

/// The mean length on the surface of a step along U and V, in proportion to each other.
glm::dvec2 step_lengths(const ChartMesh& mesh, std::span<const FlatTriangle> triangles) {
    glm::dvec2 sum(0.0);
    for (size_t t = 0; t < triangles.size(); ++t) {
        const auto corner = [&](size_t k) {
            return glm::dvec3(mesh.positions[mesh.indices[3 * t + k]]);
        };
        const glm::dvec2 a = triangles[t][1] - triangles[t][0],
                         b = triangles[t][2] - triangles[t][0];
        const double area = a.x * b.y - a.y * b.x;
        if (area == 0.0) continue;
        const glm::dvec3 u = corner(1) - corner(0), v = corner(2) - corner(0);
        const double weight = glm::length(glm::cross(u, v)) / std::abs(area);
        sum += weight * glm::dvec2(glm::length(b.y * u - a.y * v), glm::length(a.x * v - b.x * u));
    }
    const bool is_known = sum.x > 0.0 && sum.y > 0.0 && std::isfinite(sum.x + sum.y);
    return is_known ? sum : glm::dvec2(1.0);
}

}  // namespace

UvCheck check_uvs(const ChartMesh& mesh, std::span<const glm::vec2> uvs) {
    TETRALIGHT_ASSERT(uvs.size() == mesh.positions.size(), "a UV for each position");
    UvCheck check;
    std::vector<FlatTriangle> triangles;
    std::vector<Areas> areas;
    Areas total;
    for (size_t t = 0; t < mesh.indices.size() / 3; ++t) {
        const FlatTriangle triangle = uv_triangle(mesh, uvs, t);
        const bool has_uvs = std::ranges::all_of(triangle, is_finite);
        areas.push_back({has_uvs ? uv_area(triangle) : 0.0, surface_area(mesh, t)});
        total.uv += areas.back().uv;
        total.surface += areas.back().surface;
        check.outside_count += static_cast<uint32_t>(std::ranges::count_if(triangle, is_outside));
        if (has_uvs) triangles.push_back(triangle);
    }
    check.area = total.uv;
    check.overlap_area = overlap_area(triangles);
    check.lost_fraction = lost_fraction(areas, total);
    return check;
}

Unwrap keep_uvs(const ChartMesh& mesh, std::span<const glm::vec2> uvs) {
    TETRALIGHT_ASSERT(uvs.size() == mesh.positions.size(), "a UV for each position");
    std::vector<FlatTriangle> triangles;
    double flat = 0.0, surface = 0.0;
    for (size_t t = 0; t < mesh.indices.size() / 3; ++t) {
        triangles.push_back(uv_triangle(mesh, uvs, t));
        flat += uv_area(triangles.back());
        surface += surface_area(mesh, t);
    }
    Unwrap result;
    result.rotation = ChartRotation::Fixed;
    if (triangles.empty()) return result;
    const glm::dvec2 steps = step_lengths(mesh, triangles);
    const glm::dvec2 ratio = steps / std::sqrt(steps.x * steps.y);  // keeps areas
    const glm::dvec2 scale = flat > 0.0 ? std::sqrt(surface / flat) * ratio : glm::dvec2(0.0);
    const glm::dvec2 least = bounds_of(triangles).min;
    result.triangle_charts.resize(triangles.size());
    result.chart_sizes.resize(1, glm::vec2(0.0f));
    for (const FlatTriangle& triangle : triangles) {
        for (const glm::dvec2 corner : triangle) {
            const glm::vec2 uv(scale * (corner - least));
            result.corner_uvs.push_back(uv);
            result.chart_sizes[0] = glm::max(result.chart_sizes[0], uv);
        }
    }
    return result;
}

}  // namespace tetralight
