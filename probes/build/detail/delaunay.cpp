// SPDX-License-Identifier: Apache-2.0
// Links CGAL 3D triangulations (GPL-3.0-or-later).
#include <tetralight/probes/build/detail/delaunay.h>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include <tetralight/probes/build/detail/cell_sorter.h>
#include <tetralight/probes/build/detail/position_table.h>

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
using Vertex = Delaunay::Vertex_handle;

Kernel::Point_3 point(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
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

/// Inserts all positions into an empty triangulation and gives their vertices.
std::vector<Vertex> triangulate(Delaunay& delaunay, std::span<const glm::dvec3> positions) {
    std::vector<Vertex> vertices(positions.size());
    Delaunay::Cell_handle near;
    for (const uint32_t i : insertion_order(positions.size())) {
        vertices[i] = delaunay.insert(point(positions[i]), near);
        vertices[i]->info() = i;
        near = vertices[i]->cell();
    }
    return vertices;
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
        sorter.add(make_sorted_cell(corners, 4));
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

}  // namespace

struct DelaunayTetrahedra::State {
    Delaunay delaunay;
    std::vector<glm::dvec3> positions;
    std::vector<Vertex> vertices;  // one a position

    void insert_missing(std::span<const glm::dvec3> wanted, std::vector<Vertex>& found);
    bool change_to(std::span<const glm::dvec3> wanted);
};

/// Each position next to the one before it, which is near it.
void DelaunayTetrahedra::State::insert_missing(std::span<const glm::dvec3> wanted,
                                               std::vector<Vertex>& found) {
    Delaunay::Cell_handle near;
    for (uint32_t i = 0; i < wanted.size(); ++i) {
        if (found[i] == Vertex()) found[i] = delaunay.insert(point(wanted[i]), near);
        found[i]->info() = i;
        near = found[i]->cell();
    }
}

/// Changes the triangulation to other positions unless building it from scratch takes less time.
bool DelaunayTetrahedra::State::change_to(std::span<const glm::dvec3> wanted) {
    const PositionTable table(positions);
    std::vector<Vertex> found(wanted.size());
    size_t kept_count = 0;
    for (size_t i = 0; i < wanted.size(); ++i) {
        const uint32_t old = table.find(wanted[i]);
        if (old == kNoIndex) continue;
        found[i] = std::exchange(vertices[old], Vertex());
        ++kept_count;
    }
    // In units of one insertion of many.
    constexpr size_t kInsertionCost = 2;
    constexpr size_t kRemovalCost = 8;
    const size_t cost = kInsertionCost * (wanted.size() - kept_count) +
                        kRemovalCost * (positions.size() - kept_count);
    if (cost > wanted.size()) return false;

    insert_missing(wanted, found);
    for (const Vertex& vertex : vertices) {
        if (vertex != Vertex()) delaunay.remove(vertex);
    }
    vertices = std::move(found);
    positions.assign(wanted.begin(), wanted.end());
    return true;
}

DelaunayTetrahedra::DelaunayTetrahedra() : state_(std::make_unique<State>()) {}

DelaunayTetrahedra::~DelaunayTetrahedra() = default;
DelaunayTetrahedra::DelaunayTetrahedra(DelaunayTetrahedra&&) noexcept = default;
DelaunayTetrahedra& DelaunayTetrahedra::operator=(DelaunayTetrahedra&&) noexcept = default;

std::vector<Cell> DelaunayTetrahedra::change_to(std::span<const glm::dvec3> positions) {
    if (!state_->change_to(positions)) {
        *state_ = State();
        state_->vertices = triangulate(state_->delaunay, positions);
        state_->positions.assign(positions.begin(), positions.end());
    }
    if (state_->delaunay.dimension() < 3) return {};
    return sorted_cells(state_->delaunay);
}

std::vector<Cell> delaunay_tetrahedra(std::span<const glm::dvec3> positions) {
    Delaunay delaunay;
    triangulate(delaunay, positions);
    if (delaunay.dimension() < 3) return {};
    return sorted_cells(delaunay);
}

}  // namespace tetralight::detail
