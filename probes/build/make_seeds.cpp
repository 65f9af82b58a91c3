// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/make_seeds.h>

#include <algorithm>
#include <glm/common.hpp>
#include <span>
#include <tuple>
#include <vector>

#include <tetralight/base/box.h>
#include <tetralight/probes/hilbert.h>

namespace tetralight {
namespace {

/// A walk from the nearest seed then takes about five steps, for two bytes a probe.
constexpr size_t kProbesPerSeed = 8;

/// For each probe the first cell that has it as a vertex.
std::vector<uint32_t> first_cells(size_t probe_count, std::span<const Cell> cells) {
    std::vector<uint32_t> first(probe_count, kNoIndex);
    for (uint32_t i = 0; i < cells.size(); ++i) {
        for (const uint32_t probe : cells[i].vertices) {
            if (probe != kNoIndex) first[probe] = std::min(first[probe], i);
        }
    }
    return first;
}

}  // namespace

void make_seeds(ProbeVolume& volume) {
    volume.seeds.clear();
    if (volume.positions.empty()) return;
    auto bounds = Box<glm::vec3>::empty();
    for (const glm::vec3& p : volume.positions) bounds = union_of(bounds, p);
    const HilbertCube cube = make_hilbert_cube(glm::dvec3(bounds.min), glm::dvec3(bounds.max));
    const std::vector<uint32_t> cell_of_probe = first_cells(
        volume.positions.size(), std::span(volume.cells).first(volume.info.inner_cell_count));
    for (size_t i = 0; i < volume.positions.size(); i += kProbesPerSeed) {
        const uint64_t index = cube.index(glm::dvec3(volume.positions[i]));
        volume.seeds.push_back({index, cell_of_probe[i]});
    }
    std::ranges::sort(volume.seeds, [](const Seed& a, const Seed& b) {
        return std::tie(a.hilbert_index, a.cell) < std::tie(b.hilbert_index, b.cell);
    });
    volume.info.seed_cube = cube;
}

}  // namespace tetralight
