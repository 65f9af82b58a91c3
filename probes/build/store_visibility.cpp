// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/store_visibility.h>

#include <algorithm>
#include <array>
#include <optional>

#include <tetralight/base/contract.h>
#include <tetralight/probes/build/detail/position_table.h>
#include <tetralight/probes/edge_visibility.h>

namespace tetralight {
namespace {

/// Calls `use(edge, code)` for each edge of each cell, with `kFreeEdge` where it stores nothing.
template <class Use>
void for_each_code(const ProbeEdges& edges, const ProbeVolumeView& volume, Use use) {
    for (uint32_t index = 0; index < volume.cells.size(); ++index) {
        const Cell& cell = volume.cells[index];
        const uint32_t element = find_visibility(volume, index);
        for_each_edge(cell, [&](size_t i, size_t j) {
            const uint8_t code = element == kNoIndex
                                     ? kFreeEdge
                                     : volume.cell_visibility[element].codes[edge_place(i, j)];
            use(edges.find(cell.vertices[i], cell.vertices[j]), code, element != kNoIndex);
        });
    }
}

/// None if all of the cell's edges are free.
std::optional<CellVisibility> cell_codes(const ProbeEdges& edges, std::span<const uint8_t> codes,
                                         const Cell& cell) {
    CellVisibility visibility;
    bool is_stored = false;
    for_each_edge(cell, [&](size_t i, size_t j) {
        const uint8_t code = codes[edges.find(cell.vertices[i], cell.vertices[j])];
        visibility.codes[edge_place(i, j)] = code;
        is_stored |= code >= kUnknownEdge;
    });
    return is_stored ? std::optional(visibility) : std::nullopt;
}

/// A probe, and two others to which different walls block the edges from it.
using SplitEdges = std::array<uint32_t, 3>;
/// Sorted.
using SplitList = std::vector<SplitEdges>;

/// Calls `use(edges, is_split)` for each two blocked edges from a probe in each cell.
template <class Use>
void for_each_pair(const ProbeVolumeView& volume, Use use) {
    for (uint32_t index = 0; index < volume.cells.size(); ++index) {
        const uint32_t element = find_visibility(volume, index);
        if (element == kNoIndex) continue;
        const Cell& cell = volume.cells[index];
        const CellVisibility& visibility = volume.cell_visibility[element];
        for_each_blocked_pair(visibility, [&](size_t from, size_t a, size_t b) {
            const auto [low, high] = std::minmax(cell.vertices[a], cell.vertices[b]);
            use(SplitEdges{cell.vertices[from], low, high},
                (split_bits(visibility) & split_bit(from, a, b)) != 0);
        });
    }
}

SplitList split_list(const ProbeVolumeView& volume) {
    SplitList splits;
    for_each_pair(volume, [&](const SplitEdges& edges, bool is_split) {
        if (is_split) splits.push_back(edges);
    });
    std::ranges::sort(splits);
    return splits;
}

uint64_t count_torn_splits(const ProbeVolumeView& volume) {
    const SplitList splits = split_list(volume);
    SplitList torn;
    for_each_pair(volume, [&](const SplitEdges& edges, bool is_split) {
        if (!is_split && std::ranges::binary_search(splits, edges)) torn.push_back(edges);
    });
    std::ranges::sort(torn);
    return static_cast<uint64_t>(std::unique(torn.begin(), torn.end()) - torn.begin());
}

}  // namespace

void store_visibility(const ProbeEdges& edges, std::span<const uint8_t> codes,
                      ProbeVolume& volume) {
    TETRALIGHT_ASSERT(codes.size() == edges.size(), "one code an edge");
    volume.visibility_blocks.clear();
    volume.cell_visibility.clear();
    for (size_t index = 0; index < volume.cells.size(); ++index) {
        if (index % 32 == 0) {
            const auto first = static_cast<uint32_t>(volume.cell_visibility.size());
            volume.visibility_blocks.push_back({first, 0});
        }
        const auto stored = cell_codes(edges, codes, volume.cells[index]);
        if (!stored) continue;
        volume.visibility_blocks.back().cells |= uint32_t{1} << (index % 32);
        volume.cell_visibility.push_back(*stored);
    }
}

std::vector<uint8_t> edge_codes(const ProbeEdges& edges, const ProbeVolumeView& volume) {
    if (volume.visibility_blocks.empty()) return std::vector<uint8_t>(edges.size(), kUnknownEdge);
    std::vector<uint8_t> codes(edges.size(), kFreeEdge);
    for_each_code(edges, volume, [&](size_t edge, uint8_t code, bool is_stored) {
        if (is_stored) codes[edge] = code;
    });
    return codes;
}

KnownWalls::KnownWalls(const ProbeVolumeView& volume)
    : edges_(volume), codes_(edge_codes(edges_, volume)), splits_(split_list(volume)) {}

uint8_t KnownWalls::code(uint32_t from, uint32_t to) const noexcept {
    return edges_.contains(from, to) ? codes_[edges_.find(from, to)] : uint8_t{kUnknownEdge};
}

bool KnownWalls::is_split(uint32_t from, uint32_t a, uint32_t b) const noexcept {
    return std::ranges::binary_search(splits_, SplitEdges{from, std::min(a, b), std::max(a, b)});
}

void copy_visibility(const ProbeVolumeView& from, ProbeVolume& to) {
    to.visibility_blocks.clear();
    to.cell_visibility.clear();
    if (from.visibility_blocks.empty()) return;
    const detail::PositionTable table(from.exact_positions);
    std::vector<uint32_t> twins;
    for (const glm::dvec3& position : to.exact_positions) twins.push_back(table.find(position));
    const KnownWalls known(from);
    const ProbeEdges edges(to.view());
    std::vector<uint8_t> codes;
    for (uint32_t probe = 0; probe < twins.size(); ++probe) {
        for (const uint32_t target : edges.targets(probe)) {
            const uint32_t a = twins[probe], b = twins[target];
            const bool is_old = a != kNoIndex && b != kNoIndex;
            codes.push_back(is_old ? known.code(a, b) : uint8_t{kUnknownEdge});
        }
    }
    store_visibility(edges, codes, to);
    set_all_splits(to, [&](uint32_t probe, uint32_t a, uint32_t b) {
        const bool are_old =
            twins[probe] != kNoIndex && twins[a] != kNoIndex && twins[b] != kNoIndex;
        return are_old && known.is_split(twins[probe], twins[a], twins[b]);
    });
}

VisibilityFacts visibility_facts(const ProbeVolumeView& volume) {
    const ProbeEdges edges(volume);
    const std::vector<uint8_t> codes = edge_codes(edges, volume);
    VisibilityFacts facts;
    facts.marked_cells = volume.cell_visibility.size();
    facts.edges = edges.size();
    facts.unknown_edges = static_cast<uint64_t>(std::ranges::count(codes, kUnknownEdge));
    facts.blocked_edges = static_cast<uint64_t>(
        std::ranges::count_if(codes, [](uint8_t code) { return code > kUnknownEdge; }));
    std::vector<bool> is_torn(edges.size(), false);
    for_each_code(edges, volume, [&](size_t edge, uint8_t code, bool is_stored) {
        const bool agrees = is_stored ? codes[edge] == code : codes[edge] < kUnknownEdge;
        if (!agrees) is_torn[edge] = true;
    });
    facts.torn_edges = static_cast<uint64_t>(std::ranges::count(is_torn, true));
    facts.torn_splits = count_torn_splits(volume);
    return facts;
}

}  // namespace tetralight
