// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/edge_visibility.h>

namespace tetralight::test {

/// Gives a volume walls with random codes; more than a third of its edges are blocked.
inline void add_random_walls(ProbeVolume& volume, uint64_t seed) {
    const ProbeEdges edges(volume.view());
    std::mt19937_64 engine(seed);
    std::vector<uint8_t> codes(edges.size());
    for (uint8_t& code : codes) {
        code = static_cast<uint8_t>(engine() % 2 == 0 ? engine() % kUnknownEdge : engine() % 256);
    }
    store_visibility(edges, codes, volume);
}

}  // namespace tetralight::test
