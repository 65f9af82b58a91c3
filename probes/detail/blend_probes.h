// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight::detail {

/// The vertex of a cell that weight `i` belongs to, tested here, where it is used: the volume may
/// be an unverified file. Places without a vertex, whose weight is 0, give the first one.
inline uint32_t vertex_at(const ProbeVolumeView& volume, const Cell& cell, int i) noexcept {
    const size_t count = volume.positions.size();
    if (cell.vertices[i] < count) return cell.vertices[i];
    return cell.vertices[0] < count ? cell.vertices[0] : 0;
}

/// `interpolate`, in the order of operations that all kernels share: Σ w_i p_i first, then the
/// ambient part.
inline InterpolatedProbe blend_probes(const ProbeVolumeView& volume,
                                      const CellLocation& location) noexcept {
    if (location.cell >= volume.cells.size() || volume.positions.empty()) {
        return {volume.info.ambient, glm::vec4(1.0f)};
    }
    const bool is_compact = volume.compact.size() == volume.positions.size();
    const bool has_light = is_compact || volume.irradiance.size() == volume.positions.size();
    const bool has_occlusion = is_compact || volume.occlusion.size() == volume.positions.size();
    InterpolatedProbe blend{{}, glm::vec4(0.0f)};
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = vertex_at(volume, volume.cells[location.cell], i);
        const float weight = location.weights[i];
        if (has_light) {
            blend.irradiance += weight * (is_compact ? compact_irradiance(volume.compact[probe],
                                                                          volume.info.compact_scale)
                                                     : volume.irradiance[probe]);
        }
        if (has_occlusion) {
            blend.occlusion += weight * (is_compact ? compact_occlusion(volume.compact[probe])
                                                    : volume.occlusion[probe]);
        }
    }
    if (location.ambient > 0.0f) {
        blend.irradiance += location.ambient * volume.info.ambient;
        blend.occlusion += location.ambient;
    }
    if (!has_light) blend.irradiance = volume.info.ambient;
    if (!has_occlusion) blend.occlusion = glm::vec4(1.0f);
    return blend;
}

}  // namespace tetralight::detail
