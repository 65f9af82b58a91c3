// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// A position relative to the volume's local origin.
struct LocalPosition {
    glm::dvec3 position{0.0};
    /// The position is farther away and was moved to this one.
    bool is_moved = false;
};

/// A position relative to the volume's local origin. Far away only the direction matters, and
/// double could not distinguish the hull's corners: positions beyond `kFarthestExtents` are moved
/// to it.
inline LocalPosition find_local(const VolumeInfo& info, const glm::vec3& position) noexcept {
    constexpr double kFarthestExtents = 65536.0;
    const glm::dvec3 local = glm::dvec3(position) - info.world_origin;
    const double farthest = kFarthestExtents * static_cast<double>(info.extent);
    const double square = glm::dot(local, local);
    if (!(farthest > 0.0) || !(square > farthest * farthest)) return {local, false};
    return {local * (farthest / std::sqrt(square)), true};
}

inline glm::dvec3 local_position(const VolumeInfo& info, const glm::vec3& position) noexcept {
    return find_local(info, position).position;
}

/// Corners of a cell relative to a local position. Every index is tested here, where it is used:
/// the volume may be an unverified file. False: the cell is broken.
inline bool find_corners(const ProbeVolumeView& volume, uint32_t index, const glm::dvec3& position,
                         std::array<glm::dvec3, 4>& corners) noexcept {
    if (index >= volume.cells.size() || volume.info.dimension > Dimension::Space) return false;
    const bool is_inner = index < volume.info.inner_cell_count;
    const int count = cell_vertex_count(volume.info.dimension) - (is_inner ? 0 : 1);
    for (int i = 0; i < count; ++i) {
        const uint32_t probe = volume.cells[index].vertices[i];
        if (probe >= volume.positions.size()) return false;
        corners[i] = glm::dvec3(volume.positions[probe]) - position;
    }
    return true;
}

}  // namespace tetralight::detail
