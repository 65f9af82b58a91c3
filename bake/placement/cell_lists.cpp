// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/cell_lists.h>

#include <algorithm>

namespace tetralight {

Lists cells_of_probes(const ProbeVolume& volume) {
    Lists cells(volume.positions.size());
    for (uint32_t c = 0; c < volume.cells.size(); ++c) {
        for (const uint32_t probe : volume.cells[c].vertices) {
            if (probe != kNoIndex) cells[probe].push_back(c);
        }
    }
    return cells;
}

Lists sensors_of_cells(const ProbeVolume& volume, std::span<const SensorError> errors) {
    Lists sensors(volume.cells.size());
    for (uint32_t i = 0; i < errors.size(); ++i) {
        if (errors[i].cell != kNoIndex) sensors[errors[i].cell].push_back(i);
    }
    return sensors;
}

std::vector<uint32_t> probes_of_cells(const ProbeVolume& volume, std::span<const uint32_t> cells) {
    std::vector<uint32_t> probes;
    for (const uint32_t cell : cells) {
        for (const uint32_t probe : volume.cells[cell].vertices) {
            if (probe != kNoIndex) probes.push_back(probe);
        }
    }
    std::ranges::sort(probes);
    probes.erase(std::ranges::unique(probes).begin(), probes.end());
    return probes;
}

std::vector<uint32_t> named(std::span<const uint32_t> numbers, std::span<const uint32_t> names) {
    std::vector<uint32_t> result;
    for (const uint32_t number : numbers) result.push_back(names[number]);
    return result;
}

}  // namespace tetralight
