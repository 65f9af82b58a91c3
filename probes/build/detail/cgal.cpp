// SPDX-License-Identifier: Apache-2.0
// Links CGAL 2D triangulations (GPL-3.0-or-later).
#include <tetralight/probes/build/detail/cgal.h>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace tetralight::detail {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay2 = CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<
                CGAL::Triangulation_vertex_base_with_info_2<uint32_t, Kernel>,
                CGAL::Triangulation_face_base_with_info_2<uint32_t, Kernel>>>;

Kernel::Point_3 point(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

Kernel::Point_2 point(const glm::dvec2& p) {
    return {p.x, p.y};
}

/// Numbers the finite faces 0.. and the infinite ones kNoIndex.
void number_faces(const Delaunay2& delaunay) {
    uint32_t next = 0;
    for (const auto face : delaunay.all_face_handles()) {
        face->info() = delaunay.is_infinite(face) ? kNoIndex : next++;
    }
}

}  // namespace

std::vector<Cell> delaunay_triangles(std::span<const glm::dvec2> positions) {
    std::vector<std::pair<Kernel::Point_2, uint32_t>> points;
    for (uint32_t i = 0; i < positions.size(); ++i) {
        points.emplace_back(point(positions[i]), i);
    }
    const Delaunay2 delaunay(points.begin(), points.end());
    if (delaunay.dimension() < 2) return {};
    number_faces(delaunay);
    std::vector<Cell> cells;
    for (const auto handle : delaunay.finite_face_handles()) {
        Cell& cell = cells.emplace_back();
        for (int i = 0; i < 3; ++i) {
            cell.vertices[i] = handle->vertex(i)->info();
            cell.neighbors[i] = handle->neighbor(i)->info();
        }
    }
    return cells;
}

int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                const glm::dvec3& d) {
    return CGAL::orientation(point(a), point(b), point(c), point(d));
}

bool is_in_circumsphere(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                        const glm::dvec3& d, const glm::dvec3& position) {
    return CGAL::side_of_oriented_sphere(point(a), point(b), point(c), point(d), point(position)) ==
           CGAL::ON_POSITIVE_SIDE;
}

int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return CGAL::orientation(point(a), point(b), point(c));
}

bool is_in_circumcircle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                        const glm::dvec2& position) {
    return CGAL::side_of_oriented_circle(point(a), point(b), point(c), point(position)) ==
           CGAL::ON_POSITIVE_SIDE;
}

}  // namespace tetralight::detail
