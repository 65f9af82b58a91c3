// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/weld_sources.h>

#include <cstdint>
#include <vector>

#include <tetralight/probes/build/detail/weld.h>
#include <tetralight/probes/build/hilbert_order.h>

namespace tetralight::detail {

void weld_sources(std::span<const glm::dvec3> positions, double tolerance, MergedProbes& merged) {
    std::vector<glm::dvec3> distinct;
    distinct.reserve(positions.size());
    for (const uint32_t i : hilbert_order(positions)) {
        if (distinct.empty() || distinct.back() != positions[i]) distinct.push_back(positions[i]);
        merged.sources[i].probe = static_cast<uint32_t>(distinct.size() - 1);
    }
    const Weld welded = weld(distinct, tolerance);
    merged.weld_radius = welded.radius;
    std::vector<uint32_t> place(distinct.size());
    merged.positions.reserve(distinct.size());
    for (uint32_t i = 0; i < distinct.size(); ++i) {
        if (welded.representatives[i] != i) continue;
        place[i] = static_cast<uint32_t>(merged.positions.size());
        merged.positions.push_back(distinct[i]);
    }
    for (ProbeSource& source : merged.sources) {
        source.probe = place[welded.representatives[source.probe]];
    }
}

}  // namespace tetralight::detail
