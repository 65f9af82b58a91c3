// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Calls `use(from, to)` with the corners of each directed edge of a cell.
template <class Use>
void for_each_edge(const Cell& cell, Use use) {
    for (size_t i = 0; i < 4 && cell.vertices[i] != kNoIndex; ++i) {
        for (size_t j = 0; j < 4 && cell.vertices[j] != kNoIndex; ++j) {
            if (i != j) use(i, j);
        }
    }
}

/// The directed edges between the probes of a volume, each once, by the probe that they begin at.
class ProbeEdges {
  public:
    /// Those of the inner cells, which are all: hull cells have no others.
    explicit ProbeEdges(const ProbeVolumeView& volume);

    [[nodiscard]] size_t size() const noexcept { return targets_.size(); }

    /// Index of the first edge that begins at a probe; for the probe after the last, `size()`.
    [[nodiscard]] size_t first(uint32_t probe) const noexcept { return first_[probe]; }

    /// The probes that the edges from a probe lead to, ascending.
    [[nodiscard]] std::span<const uint32_t> targets(uint32_t probe) const noexcept {
        return std::span(targets_).subspan(first_[probe], first_[probe + 1] - first_[probe]);
    }

    /// The index of an edge. Precondition: there is one.
    [[nodiscard]] size_t find(uint32_t from, uint32_t to) const noexcept;

    [[nodiscard]] bool contains(uint32_t from, uint32_t to) const noexcept;

  private:
    std::vector<size_t> first_;
    std::vector<uint32_t> targets_;
};

}  // namespace tetralight
