// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// A part of the cells of a volume, with indices of the part.
struct CutCells {
    std::vector<Cell> cells;
    std::vector<HullCellRays> hull_rays;
    /// Cells of the volume; those behind them are hull cells at the cut, on faces of tetrahedra
    /// whose neighbor is not in the part.
    uint32_t cell_count = 0;
    uint32_t inner_cell_count = 0;
};

/// Cuts cells out of a volume of tetrahedra. `kept`: their indices, ascending; with each hull cell
/// the tetrahedron before it, and with each tetrahedron the hull cells behind its faces.
/// `cell_places` and `probe_places`: the index in the part of each kept cell, and of each probe
/// that they have; others kNoIndex. Links at the cut go around each edge through the cells that are
/// not kept, so that the part passes `verify`.
[[nodiscard]] CutCells cut_cells(const ProbeVolumeView& volume, std::span<const uint32_t> kept,
                                 std::span<const uint32_t> cell_places,
                                 std::span<const uint32_t> probe_places);

}  // namespace tetralight::detail
