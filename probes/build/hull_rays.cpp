// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/hull_rays.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace tetralight {
namespace {

constexpr int kFractionSteps = 64;

/// Bound of the rounding error of numbers of order 1.
constexpr double kRounding = 1e-12;

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// True if a triangle with these edges has no area beyond rounding: such triangles occur along the
/// edges of lattices. Their normals are arbitrary, and no query ends in their cells.
bool is_degenerate(const glm::dvec3& a, const glm::dvec3& b) {
    constexpr double kThinnest = 1e-9;
    const double longest = std::max(glm::dot(a, a), glm::dot(b, b));
    return !(glm::length(glm::cross(a, b)) > kThinnest * longest);
}

/// One vertex of the hull.
struct HullVertex {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};
    glm::dvec3 radial{0.0};
    glm::dvec3 ray{0.0};
};

/// The hull with vertices of its own, in units of its size. Hull cells of lower dimension leave
/// places of `cells` unused.
struct Hull {
    std::vector<HullVertex> vertices;
    std::vector<std::array<uint32_t, 3>> cells;
};

Hull make_hull(std::span<const glm::dvec3> positions, std::span<const Cell> hull_cells,
               Dimension dimension) {
    Hull hull;
    hull.cells.reserve(hull_cells.size());
    std::vector<uint32_t> hull_index(positions.size(), kNoIndex);
    for (const Cell& source : hull_cells) {
        std::array<uint32_t, 3> cell{kNoIndex, kNoIndex, kNoIndex};
        for (int k = 0; k < cell_vertex_count(dimension) - 1; ++k) {
            const uint32_t probe = source.vertices[k];
            if (hull_index[probe] == kNoIndex) {
                hull_index[probe] = static_cast<uint32_t>(hull.vertices.size());
                hull.vertices.push_back({positions[probe]});
            }
            cell[k] = hull_index[probe];
        }
        hull.cells.push_back(cell);
    }
    return hull;
}

/// Σ function(distance to `center`) over all vertices.
template <class Function>
double sum_over_distances(const Hull& hull, const glm::dvec3& center, Function function) {
    double sum = 0.0;
    for (const HullVertex& v : hull.vertices) sum += function(glm::distance(v.position, center));
    return sum;
}

/// A point inside the hull and near most of its vertices. Seen from the mean, vertices that are
/// close together would have equal directions in float, if others are far away. Steps towards the
/// geometric median (Weiszfeld 1937); each point is a mean with positive weights, thus inside.
glm::dvec3 find_interior_point(const Hull& hull) {
    constexpr int kMostSteps = 32;
    constexpr double kSmallStep = 0.01;
    const auto count = static_cast<double>(hull.vertices.size());
    glm::dvec3 center(0.0);
    for (const HullVertex& v : hull.vertices) center += v.position / count;
    for (int i = 0; i < kMostSteps; ++i) {
        const double near =
            count / sum_over_distances(hull, center, [](double d) { return 1 / d; });
        const auto weight = [near](double distance) { return 1 / (distance + near); };
        const double total = sum_over_distances(hull, center, weight);
        glm::dvec3 step(0.0);
        for (const HullVertex& v : hull.vertices) {
            const double share = weight(glm::distance(v.position, center)) / total;
            step += share * (v.position - center);
        }
        if (!(glm::length(step) > kSmallStep * near)) break;
        center += step;
    }
    return center;
}

/// Moves the interior point to the origin and scales the hull to size 1.
void normalize(Hull& hull) {
    const glm::dvec3 center = find_interior_point(hull);
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

void normalize_normals(Hull& hull) {
    for (HullVertex& v : hull.vertices) {
        const double length = glm::length(v.normal);
        v.normal = length > 0.0 ? v.normal / length : v.radial;
    }
}

void add_triangle_normals(Hull& hull) {
    for (const auto& triangle : hull.cells) {
        std::array<glm::dvec3, 3> p;
        for (int k = 0; k < 3; ++k) p[k] = hull.vertices[triangle[k]].position;
        const glm::dvec3 area = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double length = glm::length(area);
        if (is_degenerate(p[1] - p[0], p[2] - p[0])) continue;
        for (int k = 0; k < 3; ++k) {
            const double angle = angle_between(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            hull.vertices[triangle[k]].normal += area * (angle / length);
        }
    }
    normalize_normals(hull);
}

/// In a plane the normals of the edges' ends, weighted alike, halve the angles of the hull: their
/// rays never meet.
void add_edge_normals(Hull& hull, const glm::dvec3& axis) {
    for (const auto& [first, second, unused] : hull.cells) {
        const glm::dvec3 edge = hull.vertices[second].position - hull.vertices[first].position;
        const glm::dvec3 outward = glm::normalize(glm::cross(edge, axis));
        hull.vertices[first].normal += outward;
        hull.vertices[second].normal += outward;
    }
    normalize_normals(hull);
}

void set_rays(Hull& hull, double radial_fraction) {
    for (HullVertex& v : hull.vertices) {
        v.ray = glm::normalize(glm::mix(v.normal, v.radial, radial_fraction));
    }
}

/// True if g0 + g1 t + g2 t² stays positive for all t ≥ 0. Slopes that rounding alone can make (of
/// unit vectors in a hull of size 1) count as zero.
bool stays_positive(double g0, double g1, double g2) {
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
    if (is_degenerate(a, b)) return false;
    const glm::dvec3 g1 = glm::cross(da, b) + glm::cross(a, db);
    const glm::dvec3 g2 = glm::cross(da, db);
    return !std::ranges::all_of(std::array{v0.ray, v1.ray, v2.ray}, [&](const glm::dvec3& ray) {
        return stays_positive(glm::dot(g0, ray), glm::dot(g1, ray), glm::dot(g2, ray));
    });
}

bool folds_anywhere(const Hull& hull) {
    return std::ranges::any_of(hull.cells, [&](const auto& t) { return folds(hull, t); });
}

/// Smallest fraction of the radial direction, in steps, for which no triangle folds.
int find_radial_steps(Hull& hull) {
    for (int step = 0; step < kFractionSteps; ++step) {
        set_rays(hull, static_cast<double>(step) / kFractionSteps);
        if (!folds_anywhere(hull)) return step;
    }
    set_rays(hull, 1.0);
    return kFractionSteps;
}

}  // namespace

HullRays make_hull_rays(std::span<const glm::dvec3> positions,
                        const Tetrahedralization& tetrahedralization) {
    return make_hull_rays(
        positions, std::span(tetrahedralization.cells).subspan(tetrahedralization.inner_cell_count),
        tetrahedralization.dimension, tetrahedralization.axis);
}

HullRays make_hull_rays(std::span<const glm::dvec3> positions, std::span<const Cell> hull_cells,
                        Dimension dimension, const glm::dvec3& axis) {
    Hull hull = make_hull(positions, hull_cells, dimension);
    if (hull.cells.empty()) return {};
    HullRays rays;
    normalize(hull);
    if (dimension == Dimension::Space) {
        add_triangle_normals(hull);
        rays.radial_fraction = static_cast<float>(find_radial_steps(hull)) / kFractionSteps;
    } else {
        if (dimension == Dimension::Plane) {
            add_edge_normals(hull, axis);
        }
        set_rays(hull, dimension == Dimension::Line ? 1.0 : 0.0);
    }
    rays.cells.reserve(hull.cells.size());
    for (const auto& cell : hull.cells) {
        HullCellRays& cell_rays = rays.cells.emplace_back();
        for (int k = 0; k < 3; ++k) {
            if (cell[k] != kNoIndex) cell_rays.rays[k] = glm::vec3(hull.vertices[cell[k]].ray);
        }
    }
    return rays;
}

}  // namespace tetralight
