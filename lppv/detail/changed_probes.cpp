// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/detail/changed_probes.h>

#include <algorithm>
#include <glm/common.hpp>

#include <tetralight/base/contract.h>
#include <tetralight/probes/no_index.h>

namespace tetralight::detail {

void LitBy::assign(const ProbeVolumeView& probes, std::span<const CellLocation> locations) {
    cells.clear();
    bool is_first = true;
    uint32_t last = kNoIndex;
    for (const CellLocation& location : locations) {
        // Consecutive points are often in the same cell.
        if (location.cell == last || location.cell >= probes.cells.size()) continue;
        last = location.cell;
        cells.push_back(last);
        for (const uint32_t probe : probes.cells[last].vertices) {
            if (probe >= probes.positions.size()) continue;
            const glm::vec3& position = probes.positions[probe];
            min = is_first ? position : glm::min(min, position);
            max = is_first ? position : glm::max(max, position);
            is_first = false;
        }
    }
}

ChangedProbes::ChangedProbes(const ProbeVolumeView& probes, std::span<const uint32_t> changed,
                             bool is_everything)
    : probes_(probes), is_everything_(is_everything) {
    if (is_everything_ || changed.empty()) return;
    is_changed_.resize(probes.positions.size());
    for (const uint32_t probe : changed) {
        TETRALIGHT_ASSERT(probe < is_changed_.size(), "changed probes are probes of the volume");
        is_changed_[probe] = true;
        const glm::vec3& position = probes.positions[probe];
        min_ = is_empty_ ? position : glm::min(min_, position);
        max_ = is_empty_ ? position : glm::max(max_, position);
        is_empty_ = false;
    }
}

bool ChangedProbes::light(const LitBy& volume) const {
    if (is_everything_) return true;
    if (is_empty_) return false;
    for (int axis = 0; axis < 3; ++axis) {
        if (min_[axis] > volume.max[axis] || max_[axis] < volume.min[axis]) return false;
    }
    return std::ranges::any_of(volume.cells, [&](uint32_t cell) { return has_changed(cell); });
}

bool ChangedProbes::has_changed(uint32_t cell) const {
    if (cell >= probes_.cells.size()) return false;
    return std::ranges::any_of(probes_.cells[cell].vertices, [&](uint32_t probe) {
        return probe < is_changed_.size() && is_changed_[probe];
    });
}

}  // namespace tetralight::detail
