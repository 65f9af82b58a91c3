// SPDX-License-Identifier: Apache-2.0
// Links CGAL 3D triangulations (GPL-3.0-or-later).
#include "probes/build/detail/cgal.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "probes/build/detail/cell_sorter.h"

namespace tetralight::detail {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<uint32_t, Kernel>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<uint32_t, Kernel,
                                              CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel,
                                   CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

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

/// A random number that depends on `i` alone.
uint32_t hash(uint32_t i) {
    i = (i ^ i >> 16) * 0x7feb352du;
    i = (i ^ i >> 15) * 0x846ca68bu;
    return i ^ i >> 16;
}

/// Rounds of insertion, each a random quarter of the positions of the next, in the order in which
/// the positions come: "biased randomized insertion order" (Amenta, Choi & Rote 2003).
std::vector<uint32_t> insertion_order(size_t count) {
    constexpr int kRounds = 12;
    std::vector<uint8_t> rounds(count);
    std::array<uint32_t, kRounds + 1> begins{};
    for (uint32_t i = 0; i < count; ++i) {
        const int level = std::min(std::countr_zero(hash(i)) / 2, kRounds - 1);
        rounds[i] = static_cast<uint8_t>(kRounds - 1 - level);
        ++begins[rounds[i] + 1];
    }
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<uint32_t> order(count);
    for (uint32_t i = 0; i < count; ++i) order[begins[rounds[i]]++] = i;
    return order;
}

Delaunay triangulate(std::span<const glm::dvec3> positions) {
    Delaunay delaunay;
    Delaunay::Cell_handle near;
    for (const uint32_t i : insertion_order(positions.size())) {
        const Delaunay::Vertex_handle vertex = delaunay.insert(point(positions[i]), near);
        vertex->info() = i;
        near = vertex->cell();
    }
    return delaunay;
}

void prefetch_vertices(const Delaunay::Cell& cell) {
    for (int i = 0; i < 4; ++i) __builtin_prefetch(&cell.vertex(i)->info());
}

void prefetch_neighbors(const Delaunay::Cell& cell) {
    for (int i = 0; i < 4; ++i) __builtin_prefetch(&cell.neighbor(i)->info());
}

/// Calls `visit` for every cell and, some cells earlier, `prefetch`: the cells stand in no order
/// that has their vertices and neighbors in the cache.
template <class Prefetch, class Visit>
void for_each_cell(Delaunay& delaunay, const Prefetch& prefetch, const Visit& visit) {
    constexpr int kAhead = 12;
    auto& cells = delaunay.tds().cells();
    auto ahead = cells.begin();
    for (int i = 0; i < kAhead && ahead != cells.end(); ++i) prefetch(*ahead++);
    for (auto cell = cells.begin(); cell != cells.end(); ++cell) {
        if (ahead != cells.end()) prefetch(*ahead++);
        visit(cell);
    }
}

/// Numbers the finite cells 0.., the infinite ones kNoIndex, and counts the finite ones.
uint32_t count_cells(Delaunay& delaunay, CellSorter& sorter) {
    uint32_t finite_count = 0;
    for_each_cell(delaunay, prefetch_vertices, [&](const auto& cell) {
        std::array<uint32_t, 4> v;
        for (int i = 0; i < 4; ++i) v[i] = cell->vertex(i)->info();
        const auto [first, last] = std::ranges::minmax(v);
        cell->info() = last == kNoIndex ? kNoIndex : finite_count++;
        if (last != kNoIndex) sorter.count(first);
    });
    return finite_count;
}

void add_cells(Delaunay& delaunay, CellSorter& sorter) {
    const auto prefetch = [](const Delaunay::Cell& cell) {
        prefetch_vertices(cell);
        prefetch_neighbors(cell);
    };
    for_each_cell(delaunay, prefetch, [&](const auto& cell) {
        if (cell->info() == kNoIndex) return;
        std::array<uint64_t, 4> corners;
        for (int i = 0; i < 4; ++i) {
            corners[i] = make_corner(cell->vertex(i)->info(), cell->neighbor(i)->info());
        }
        sorter.add(make_sorted_cell(corners, 4), cell->info());
    });
}

/// The finite cells in canonical order.
std::vector<Cell> sorted_cells(Delaunay& delaunay) {
    delaunay.infinite_vertex()->info() = kNoIndex;
    CellSorter sorter(delaunay.number_of_vertices());
    const uint32_t finite_count = count_cells(delaunay, sorter);
    sorter.reserve_places(delaunay.number_of_cells() - finite_count);
    add_cells(delaunay, sorter);
    return sorter.finish();
}

/// Numbers the finite faces 0.. and the infinite ones kNoIndex.
void number_faces(const Delaunay2& delaunay) {
    uint32_t next = 0;
    for (const auto face : delaunay.all_face_handles()) {
        face->info() = delaunay.is_infinite(face) ? kNoIndex : next++;
    }
}

}  // namespace

std::vector<Cell> delaunay_tetrahedra(std::span<const glm::dvec3> positions) {
    Delaunay delaunay = triangulate(positions);
    if (delaunay.dimension() < 3) return {};
    return sorted_cells(delaunay);
}

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
