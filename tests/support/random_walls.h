// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/edge_visibility.h>

namespace tetralight::test {

/// Gives a volume walls with random codes and splits; more than a third of its edges are blocked.
inline void add_random_walls(ProbeVolume& volume, uint64_t seed) {
    const ProbeEdges edges(volume.view());
    std::mt19937_64 engine(seed);
    std::vector<uint8_t> codes(edges.size());
    for (uint8_t& code : codes) {
        code = static_cast<uint8_t>(engine() % 2 == 0 ? engine() % kUnknownEdge : engine() % 256);
    }
    store_visibility(edges, codes, volume);
    set_all_splits(volume, [&](uint32_t from, uint32_t a, uint32_t b) {
        std::mt19937_64 coin(seed + 0x9e3779b97f4a7c15u * (from + 31u * (a + 31u * uint64_t{b})));
        return coin() % 2 == 0;
    });
}

}  // namespace tetralight::test
