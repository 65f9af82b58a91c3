// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/canonical_cells.h>

#include <algorithm>
#include <array>
#include <utility>

#include <tetralight/probes/build/detail/cell_sorter.h>
#include <tetralight/probes/build/detail/hull_cells.h>

namespace tetralight::detail {
namespace {

Cell with_sorted_corners(const Cell& cell, int vertex_count) {
    std::array<uint64_t, 4> corners;
    for (int i = 0; i < 4; ++i) corners[i] = make_corner(cell.vertices[i], cell.neighbors[i]);
    return make_sorted_cell(corners, vertex_count);
}

std::vector<Cell> sort_cells(std::vector<Cell> cells, Dimension dimension) {
    uint32_t vertex_count = 0;
    size_t hull_cell_count = 0;
    for (Cell& cell : cells) {
        cell = with_sorted_corners(cell, cell_vertex_count(dimension));
        vertex_count = std::max(vertex_count, cell.vertices[0] + 1);
        hull_cell_count += static_cast<size_t>(std::ranges::count(cell.neighbors, kNoIndex));
    }
    CellSorter sorter(vertex_count);
    for (const Cell& cell : cells) sorter.count(cell.vertices[0]);
    sorter.reserve_places(hull_cell_count);
    for (const Cell& cell : cells) sorter.add(cell);
    return sorter.finish();
}

}  // namespace

Tetrahedralization canonical_cells(std::vector<Cell> cells, Dimension dimension) {
    return with_hull_cells(sort_cells(std::move(cells), dimension), dimension);
}

Tetrahedralization with_hull_cells(std::vector<Cell> cells, Dimension dimension) {
    const auto inner_count = static_cast<uint32_t>(cells.size());
    add_hull_cells(cells, dimension);
    return {std::move(cells), inner_count, dimension, glm::dvec3(0.0)};
}

}  // namespace tetralight::detail
