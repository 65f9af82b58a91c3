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

/// Far away only the direction matters, and double could not distinguish the hull's corners:
/// positions farther away than this are moved to it. Not for volumes without an extent.
inline double farthest_reach(const VolumeInfo& info) noexcept {
    constexpr double kFarthestExtents = 65536.0;
    return kFarthestExtents * static_cast<double>(info.extent);
}

inline LocalPosition within_reach(const VolumeInfo& info, const glm::dvec3& local) noexcept {
    const double farthest = farthest_reach(info);
    const double square = glm::dot(local, local);
    if (!(farthest > 0.0) || !(square > farthest * farthest)) return {local, false};
    return {local * (farthest / std::sqrt(square)), true};
}

/// A position relative to the volume's local origin, within reach.
inline LocalPosition find_local(const VolumeInfo& info, const glm::vec3& position) noexcept {
    return within_reach(info, glm::dvec3(position) - info.world_origin);
}

/// The foot of a local position on the plane or line of a flat volume: its cells do not depend on
/// the distance from there, which could cost all digits.
inline glm::dvec3 foot_on_probes(const ProbeVolumeView& volume, const glm::dvec3& local) noexcept {
    if (volume.positions.empty()) return local;
    const glm::dvec3 probe(volume.positions[0]);
    const glm::dvec3 along = volume.info.axis * glm::dot(volume.info.axis, local - probe);
    switch (volume.info.dimension) {
        case Dimension::Plane:
            return local - along;
        case Dimension::Line:
            return probe + along;
        default:
            return local;
    }
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
