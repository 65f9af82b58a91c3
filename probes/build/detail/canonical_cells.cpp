// SPDX-License-Identifier: Apache-2.0
#include "probes/build/detail/canonical_cells.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace tetralight::detail {
namespace {

void swap_corners(Cell& cell, int a, int b) {
    std::swap(cell.vertices[a], cell.vertices[b]);
    std::swap(cell.neighbors[a], cell.neighbors[b]);
}

/// Sorts the vertices; an odd permutation is made even by swapping the last two, so that the cell
/// stays positively oriented.
void sort_corners(Cell& cell) {
    bool is_odd = false;
    constexpr std::pair<int, int> kNetwork[] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}, {1, 2}};
    for (const auto& [a, b] : kNetwork) {
        if (cell.vertices[a] < cell.vertices[b]) continue;
        swap_corners(cell, a, b);
        is_odd = !is_odd;
    }
    if (is_odd) swap_corners(cell, 2, 3);
}

/// Orders cells by their vertices and renames neighbors to match.
void sort_cells(std::vector<Cell>& cells) {
    std::vector<uint32_t> order(cells.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, [&](uint32_t i) { return cells[i].vertices; });
    std::vector<uint32_t> place(cells.size());
    for (uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;

    std::vector<Cell> sorted;
    sorted.reserve(cells.size());
    for (const uint32_t i : order) {
        sorted.push_back(cells[i]);
        for (uint32_t& neighbor : sorted.back().neighbors) {
            if (neighbor != kNoIndex) neighbor = place[neighbor];
        }
    }
    cells = std::move(sorted);
}

/// The hull cell over one face: its smallest vertex first, counter-clockwise seen from outside.
Cell hull_cell(const Cell& tetrahedron, uint32_t index, int face) {
    const auto& corners = kOutwardFaces[face];
    Cell cell;
    for (int i = 0; i < 3; ++i) cell.vertices[i] = tetrahedron.vertices[corners[i]];
    std::rotate(cell.vertices.begin(),
                std::min_element(cell.vertices.begin(), cell.vertices.begin() + 3),
                cell.vertices.begin() + 3);
    cell.neighbors[3] = index;
    return cell;
}

std::vector<Cell> make_hull_cells(const std::vector<Cell>& tetrahedra) {
    std::vector<Cell> hull;
    for (uint32_t i = 0; i < tetrahedra.size(); ++i) {
        for (int face = 0; face < 4; ++face) {
            if (tetrahedra[i].neighbors[face] == kNoIndex) {
                hull.push_back(hull_cell(tetrahedra[i], i, face));
            }
        }
    }
    std::ranges::sort(hull, {}, &Cell::vertices);
    return hull;
}

/// Every edge of the hull has one triangle on each side, which run along it in opposite directions.
void link_hull_cells(std::vector<Cell>& hull, uint32_t first_index) {
    const auto edge = [](uint32_t from, uint32_t to) { return uint64_t{from} << 32 | to; };
    std::unordered_map<uint64_t, uint32_t> cell_of_edge;
    for (uint32_t i = 0; i < hull.size(); ++i) {
        const auto& v = hull[i].vertices;
        for (int k = 0; k < 3; ++k) cell_of_edge[edge(v[(k + 1) % 3], v[(k + 2) % 3])] = i;
    }
    for (Cell& cell : hull) {
        const auto& v = cell.vertices;
        for (int k = 0; k < 3; ++k) {
            cell.neighbors[k] = first_index + cell_of_edge.at(edge(v[(k + 2) % 3], v[(k + 1) % 3]));
        }
    }
}

void link_tetrahedra_to_hull(std::vector<Cell>& tetrahedra, const std::vector<Cell>& hull) {
    for (uint32_t i = 0; i < hull.size(); ++i) {
        Cell& inner = tetrahedra[hull[i].neighbors[3]];
        for (int face = 0; face < 4; ++face) {
            const auto first = hull[i].vertices.begin();
            if (std::find(first, first + 3, inner.vertices[face]) == first + 3) {
                inner.neighbors[face] = static_cast<uint32_t>(tetrahedra.size()) + i;
            }
        }
    }
}

}  // namespace

Tetrahedralization canonical_cells(std::vector<Cell> tetrahedra) {
    for (Cell& cell : tetrahedra) sort_corners(cell);
    sort_cells(tetrahedra);
    std::vector<Cell> hull = make_hull_cells(tetrahedra);
    const auto tetrahedron_count = static_cast<uint32_t>(tetrahedra.size());
    link_hull_cells(hull, tetrahedron_count);
    link_tetrahedra_to_hull(tetrahedra, hull);
    tetrahedra.insert(tetrahedra.end(), hull.begin(), hull.end());
    return {std::move(tetrahedra), tetrahedron_count};
}

}  // namespace tetralight::detail
