// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/probes/build/probe_edges.h>
#include <tetralight/probes/edge_visibility.h>
#include <tetralight/probes/probe_volume.h>

// The codes of a volume's edges (probes/edge_visibility.h), by edge and by cell.

namespace tetralight {

/// Stores the code of each edge in the cells around it, without splits. Cells whose edges are all
/// free store nothing. Precondition: one code an edge of the volume.
void store_visibility(const ProbeEdges& edges, std::span<const uint8_t> codes, ProbeVolume& volume);

/// Sets which blocked edges of a cell different walls block: calls `is_split(from, a, b)` with
/// probes a < b where the edges from a probe to both are blocked. It has to say the same for every
/// cell around these three, so that weights are continuous.
template <class IsSplit>
void set_splits(const Cell& cell, CellVisibility& visibility, IsSplit is_split) {
    uint32_t bits = 0;
    for_each_blocked_pair(visibility, [&](size_t from, size_t a, size_t b) {
        const auto [low, high] = std::minmax(cell.vertices[a], cell.vertices[b]);
        if (is_split(cell.vertices[from], low, high)) bits |= split_bit(from, a, b);
    });
    visibility.splits = {static_cast<uint8_t>(bits), static_cast<uint8_t>(bits >> 8)};
}

/// The same for all cells that store something.
template <class IsSplit>
void set_all_splits(ProbeVolume& volume, IsSplit is_split) {
    for (uint32_t index = 0; index < volume.cells.size(); ++index) {
        const uint32_t element = find_visibility(volume.view(), index);
        if (element == kNoIndex) continue;
        set_splits(volume.cells[index], volume.cell_visibility[element], is_split);
    }
}

/// The code of each edge: those of cells that store nothing are `kFreeEdge`. All edges are
/// `kUnknownEdge` if the volume knows no walls. Precondition: the volume passes `verify`.
[[nodiscard]] std::vector<uint8_t> edge_codes(const ProbeEdges& edges,
                                              const ProbeVolumeView& volume);

/// What a volume knows of the walls between its probes, by edges.
class KnownWalls {
  public:
    /// Precondition: the volume passes `verify` and knows walls. It need not stay.
    explicit KnownWalls(const ProbeVolumeView& volume);

    /// The code of the edge from one probe to another; `kUnknownEdge` if there is none.
    [[nodiscard]] uint8_t code(uint32_t from, uint32_t to) const noexcept;

    /// Whether different walls block the edges from a probe to two others.
    [[nodiscard]] bool is_split(uint32_t from, uint32_t a, uint32_t b) const noexcept;

  private:
    ProbeEdges edges_;
    std::vector<uint8_t> codes_;
    std::vector<std::array<uint32_t, 3>> splits_;  // from, then a < b; sorted
};

/// Copies what a volume knows of walls to another one: the codes of edges between probes of exactly
/// the same world positions. Other edges are unknown, which counts as free. Precondition: both have
/// their exact positions.
void copy_visibility(const ProbeVolumeView& from, ProbeVolume& to);

/// What a volume knows of walls.
struct VisibilityFacts {
    uint64_t marked_cells = 0;  ///< cells with an edge that is blocked or unknown
    uint64_t edges = 0;         ///< directed
    uint64_t blocked_edges = 0;
    uint64_t unknown_edges = 0;
    /// Edges that have different codes in the cells around them; 0 in a valid volume.
    uint64_t torn_edges = 0;
    /// The same of splits, by faces.
    uint64_t torn_splits = 0;

    bool operator==(const VisibilityFacts&) const = default;
};

/// Precondition: the volume passes `verify` and knows walls.
[[nodiscard]] VisibilityFacts visibility_facts(const ProbeVolumeView& volume);

}  // namespace tetralight
