// SPDX-License-Identifier: Apache-2.0
#include "probes/build/hull_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>

namespace tetralight {
namespace {

constexpr int kShareSteps = 64;

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// One vertex of the hull.
struct HullVertex {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};
    glm::dvec3 radial{0.0};
    glm::dvec3 ray{0.0};
};

/// The hull with vertices of its own, in units of its size.
struct Hull {
    std::vector<HullVertex> vertices;
    std::vector<std::array<uint32_t, 3>> triangles;
};

Hull make_hull(std::span<const glm::dvec3> positions, const Tetrahedralization& cells) {
    Hull hull;
    std::unordered_map<uint32_t, uint32_t> hull_index;
    for (size_t i = cells.tetrahedron_count; i < cells.cells.size(); ++i) {
        std::array<uint32_t, 3> triangle;
        for (int k = 0; k < 3; ++k) {
            const uint32_t probe = cells.cells[i].vertices[k];
            const auto [entry, is_new] =
                hull_index.try_emplace(probe, static_cast<uint32_t>(hull.vertices.size()));
            if (is_new) hull.vertices.push_back({positions[probe]});
            triangle[k] = entry->second;
        }
        hull.triangles.push_back(triangle);
    }
    return hull;
}

/// Moves the interior point to the origin and scales the hull to size 1.
void normalize(Hull& hull) {
    glm::dvec3 center(0.0);
    for (const HullVertex& v : hull.vertices) {
        center += v.position / static_cast<double>(hull.vertices.size());
    }
    double size = 0.0;
    for (HullVertex& v : hull.vertices) {
        v.position -= center;
        size = std::max(size, glm::length(v.position));
    }
    for (HullVertex& v : hull.vertices) {
        v.position /= size;
        v.radial = glm::normalize(v.position);
    }
}

void add_normals(Hull& hull) {
    for (const auto& triangle : hull.triangles) {
        std::array<glm::dvec3, 3> p;
        for (int k = 0; k < 3; ++k) p[k] = hull.vertices[triangle[k]].position;
        const glm::dvec3 area = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double length = glm::length(area);
        if (!(length > 0.0)) continue;
        for (int k = 0; k < 3; ++k) {
            const double angle = angle_between(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            hull.vertices[triangle[k]].normal += area * (angle / length);
        }
    }
    for (HullVertex& v : hull.vertices) {
        const double length = glm::length(v.normal);
        v.normal = length > 0.0 ? v.normal / length : v.radial;
    }
}

void set_rays(Hull& hull, double radial_share) {
    for (HullVertex& v : hull.vertices) {
        v.ray = glm::normalize(glm::mix(v.normal, v.radial, radial_share));
    }
}

/// Whether g0 + g1 t + g2 t² stays positive for all t ≥ 0. Slopes that rounding alone can make (of
/// unit vectors in a hull of size 1) count as zero.
bool stays_positive(double g0, double g1, double g2) {
    constexpr double kRounding = 1e-12;
    if (std::abs(g1) < kRounding) g1 = 0.0;
    if (std::abs(g2) < kRounding) g2 = 0.0;
    if (!(g0 > 0.0) || g2 < 0.0) return false;
    return g1 >= 0.0 || 4.0 * g0 * g2 > g1 * g1;
}

/// The extruded triangle keeps its orientation at every distance if the volume element
/// det[A + tA', B + tB', v_i] stays positive at its three corners (it is linear between them).
bool folds(const Hull& hull, const std::array<uint32_t, 3>& triangle) {
    const HullVertex& v0 = hull.vertices[triangle[0]];
    const HullVertex& v1 = hull.vertices[triangle[1]];
    const HullVertex& v2 = hull.vertices[triangle[2]];
    const glm::dvec3 a = v0.position - v2.position, da = v0.ray - v2.ray;
    const glm::dvec3 b = v1.position - v2.position, db = v1.ray - v2.ray;
    const glm::dvec3 g0 = glm::cross(a, b);
    const glm::dvec3 g1 = glm::cross(da, b) + glm::cross(a, db);
    const glm::dvec3 g2 = glm::cross(da, db);
    return !std::ranges::all_of(std::array{v0.ray, v1.ray, v2.ray}, [&](const glm::dvec3& ray) {
        return stays_positive(glm::dot(g0, ray), glm::dot(g1, ray), glm::dot(g2, ray));
    });
}

bool folds_anywhere(const Hull& hull) {
    return std::ranges::any_of(hull.triangles, [&](const auto& t) { return folds(hull, t); });
}

}  // namespace

HullRays make_hull_rays(std::span<const glm::dvec3> positions,
                        const Tetrahedralization& tetrahedralization) {
    Hull hull = make_hull(positions, tetrahedralization);
    if (hull.triangles.empty()) return {};
    normalize(hull);
    add_normals(hull);
    int step = 0;
    set_rays(hull, 0.0);
    while (step < kShareSteps && folds_anywhere(hull)) {
        ++step;
        set_rays(hull, static_cast<double>(step) / kShareSteps);
    }
    HullRays rays;
    rays.radial_share = static_cast<float>(step) / kShareSteps;
    for (const auto& triangle : hull.triangles) {
        HullCellRays cell;
        for (int k = 0; k < 3; ++k) cell.rays[k] = glm::vec3(hull.vertices[triangle[k]].ray);
        rays.cells.push_back(cell);
    }
    return rays;
}

}  // namespace tetralight
