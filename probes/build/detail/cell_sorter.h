// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <tetralight/base/compiler.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// A vertex above the neighbor opposite it, so that they move as one.
constexpr uint64_t make_corner(uint32_t vertex, uint32_t neighbor) {
    return uint64_t{vertex} << 32 | neighbor;
}

/// Sorts two corners and returns 1 if they were in the wrong order. Without a branch, because its
/// outcome cannot be predicted.
inline uint32_t sort_two(uint64_t& a, uint64_t& b) {
    const uint64_t low = a < b ? a : b;
    const uint64_t high = a < b ? b : a;
    const uint32_t is_swap = low != a;
    a = low;
    b = high;
    return is_swap;
}

/// An inner cell with its corners sorted; an odd permutation is made even by swapping the last two,
/// so that the cell keeps its orientation. (A segment's is that of its axis.) Unused corners are
/// kNoIndex twice and stay behind.
///
/// In the header because it must stay in registers: a load of what was just stored in halves would
/// wait for every store before it.
inline Cell make_sorted_cell(std::array<uint64_t, 4> corners, int vertex_count) {
    auto& [a, b, c, d] = corners;
    const uint32_t swaps =
        sort_two(a, b) + sort_two(c, d) + sort_two(a, c) + sort_two(b, d) + sort_two(b, c);
    if (swaps % 2 == 1) std::swap(corners[vertex_count - 2], corners[vertex_count - 1]);
    Cell cell;
    for (int i = 0; i < 4; ++i) {
        cell.vertices[i] = static_cast<uint32_t>(corners[i] >> 32);
        cell.neighbors[i] = static_cast<uint32_t>(corners[i]);
    }
    return cell;
}

/// Orders inner cells by their vertices and renames neighbors to match, without a copy of them
/// beside the result: a counting sort by the first vertex as they come, then a comparison sort of
/// the few cells that share it.
///
/// The caller visits its cells twice in the same order, their corners sorted:
///
///     CellSorter sorter(probe_count);
///     for (each cell) sorter.count(cell.vertices[0]);
///     sorter.reserve_places(hull_cell_count);
///     for (each cell) sorter.add(cell);  // neighbors are numbered as the cells come, 0..
///     std::vector<Cell> cells = sorter.finish();
class CellSorter {
  public:
    explicit CellSorter(size_t vertex_count) : begins_(vertex_count + 1, 0) {}

    void count(uint32_t first_vertex) { ++begins_[size_t{first_vertex} + 1]; }

    /// Keeps room behind the cells for what will be added to the result.
    void reserve_places(size_t extra_cells);

    /// How far ahead of the cells `expect` is called.
    static constexpr size_t kAhead = 16;

    /// Optional: a cell with this first vertex comes soon. Places lie far apart: fetched when their
    /// turn comes, each store would wait.
    void expect(uint32_t first_vertex) const { prefetch_for_writing(&cells_[next_[first_vertex]]); }

    void add(const Cell& cell) {
        const uint32_t place = next_[cell.vertices[0]]++;
        cells_[place] = cell;
        numbers_[place] = added_++;
    }

    [[nodiscard]] std::vector<Cell> finish();

  private:
    void sort_bucket(uint32_t begin, uint32_t end);
    void insert_in_order(uint32_t begin, uint32_t index);

    std::vector<uint32_t> begins_;  // of the cells of each first vertex; last, their number
    std::vector<uint32_t> next_;    // free place of each first vertex
    std::vector<Cell> cells_;
    std::vector<uint32_t> numbers_;  // of the cell in each place
    uint32_t added_ = 0;
};

}  // namespace tetralight::detail
