// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/probes/delaunay/delaunay_tetrahedra.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// The cells of a volume that follow tetrahedra as they change: as many cells are written as have
/// changed, a few times.
///
/// Probe p is vertex p + 1. Inner cells come first, then hull cells, both in no order. Where there
/// are fewer than before, copies of a hull cell fill the end of the array, so that every index of
/// a cell that someone kept still leads to one.
class FollowingCells {
  public:
    /// Writes all cells. Inner cells are ordered by their smallest vertex, as in a volume from a
    /// file, for the cache.
    void write_all(const DelaunayTetrahedra& tetrahedra, std::vector<Cell>& cells);

    /// Writes what has changed since the last call (DelaunayTetrahedra::changed_cells).
    void write_changes(const DelaunayTetrahedra& tetrahedra, std::vector<Cell>& cells);

    [[nodiscard]] uint32_t inner_count() const { return inner_count_; }

    /// Inner cells and hull cells, without the copies behind them.
    [[nodiscard]] uint32_t count() const { return count_; }

    /// Indices of the cells that the last call wrote; empty after `write_all`, which wrote all.
    [[nodiscard]] std::span<const uint32_t> written() const { return written_; }

  private:
    struct Changes;

    void sort_out(const DelaunayTetrahedra& tetrahedra, Changes& changes);
    void place_inner(Changes& changes);
    void place_hull(Changes& changes);
    void put(uint32_t slot, uint32_t place);
    void move(uint32_t from, uint32_t to, Changes& changes);
    void fill_end(std::vector<Cell>& cells) const;
    [[nodiscard]] Cell cell_of(const DelaunayTetrahedra& tetrahedra, uint32_t slot) const;

    std::vector<uint32_t> places_;    // the index of the cell of each DelaunayCell, or kNoIndex
    std::vector<uint32_t> slots_;     // the index of the DelaunayCell of each cell, or kNoIndex
    std::vector<uint8_t> is_marked_;  // by DelaunayCell
    std::vector<uint32_t> written_;
    uint32_t inner_count_ = 0;
    uint32_t count_ = 0;
};

}  // namespace tetralight::detail
