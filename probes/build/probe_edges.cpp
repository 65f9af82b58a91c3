// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/probe_edges.h>

#include <algorithm>

#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

/// Calls `use(from, to)` with the probes of each directed edge of each inner cell.
template <class Use>
void for_each_inner_edge(const ProbeVolumeView& volume, Use use) {
    for (const Cell& cell : volume.cells.first(volume.info.inner_cell_count)) {
        for_each_edge(cell, [&](size_t i, size_t j) { use(cell.vertices[i], cell.vertices[j]); });
    }
}

}  // namespace

ProbeEdges::ProbeEdges(const ProbeVolumeView& volume) : first_(volume.positions.size() + 1, 0) {
    for_each_inner_edge(volume, [&](uint32_t from, uint32_t) { ++first_[from]; });
    size_t end = 0;
    for (size_t& first : first_) end = first += end;
    targets_.resize(end);
    for_each_inner_edge(volume, [&](uint32_t from, uint32_t to) { targets_[--first_[from]] = to; });
    size_t kept = 0;
    for (size_t probe = 0; probe + 1 < first_.size(); ++probe) {
        const auto begin = targets_.begin() + static_cast<std::ptrdiff_t>(first_[probe]);
        const auto after = targets_.begin() + static_cast<std::ptrdiff_t>(first_[probe + 1]);
        std::sort(begin, after);
        const auto unique_end = std::unique(begin, after);
        first_[probe] = kept;
        kept = static_cast<size_t>(
            std::copy(begin, unique_end, targets_.begin() + static_cast<std::ptrdiff_t>(kept)) -
            targets_.begin());
    }
    first_.back() = kept;
    targets_.resize(kept);
    targets_.shrink_to_fit();
}

size_t ProbeEdges::find(uint32_t from, uint32_t to) const noexcept {
    const auto all = targets(from);
    const auto place = std::ranges::lower_bound(all, to);
    TETRALIGHT_ASSERT(place != all.end() && *place == to, "the volume has this edge");
    return first_[from] + static_cast<size_t>(place - all.begin());
}

bool ProbeEdges::contains(uint32_t from, uint32_t to) const noexcept {
    return std::ranges::binary_search(targets(from), to);
}

}  // namespace tetralight
