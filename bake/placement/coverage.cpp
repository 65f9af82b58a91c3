// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/coverage.h>

#include <tetralight/bake/blocked_fraction.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/no_index.h>

namespace tetralight {

Cover cover_of(const TraceScene& traced, const ProbeVolumeView& volume, const glm::dvec3& place) {
    const CellLocation location = locate(volume, glm::vec3(place));
    if (location.cell == kNoIndex || location.cell >= volume.info.inner_cell_count) {
        return Cover::HullCell;
    }
    const glm::vec3 here = traced.render_from_world(place);
    const Cell& cell = volume.cells[location.cell];
    float seen = 0.0f, hidden = 0.0f;
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = cell.vertices[static_cast<size_t>(i)];
        const float weight = location.weights[i];
        if (probe >= volume.probe_count() || !(weight > 0.0f)) continue;
        const glm::dvec3 world =
            volume.exact_positions.size() == volume.positions.size()
                ? volume.exact_positions[probe]
                : volume.info.world_origin + glm::dvec3(volume.positions[probe]);
        const glm::vec3 eye = traced.render_from_world(world);
        (eye == here || !blocked_fraction(traced, eye, here) ? seen : hidden) += weight;
        if (seen >= kMinSeenWeight) return Cover::Covered;
        if (hidden > 1.0f - kMinSeenWeight) return Cover::Unseen;
    }
    return Cover::Unseen;
}

std::vector<Cover> find_cover(const TraceScene& traced, const ProbeVolumeView& volume,
                              std::span<const glm::dvec3> places, uint32_t thread_count) {
    std::vector<Cover> covers(places.size());
    parallel_for(places.size(), thread_count,
                 [&](size_t i) { covers[i] = cover_of(traced, volume, places[i]); });
    return covers;
}

Coverage count_cover(std::span<const Cover> covers) {
    Coverage coverage;
    for (const Cover cover : covers) ++coverage.counts[static_cast<size_t>(cover)];
    return coverage;
}

}  // namespace tetralight
