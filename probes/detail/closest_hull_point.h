// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// A point of the hull: barycentric in one hull cell's triangle (edge, probe).
struct HullPoint {
    uint32_t cell = kNoIndex;
    glm::dvec3 weights{0.0};
    double distance = 0.0;
};

/// The point of the convex hull that is closest to a local position outside of it, by descent over
/// neighboring triangles from the hull cell that holds the position. None: the volume is broken.
[[nodiscard]] std::optional<HullPoint> closest_hull_point(const ProbeVolumeView& volume,
                                                          const glm::dvec3& position,
                                                          uint32_t hull_cell) noexcept;

/// Replaces a location in a hull cell by that of the policies Clamp and Ambient.
[[nodiscard]] CellLocation clamp_to_hull(const ProbeVolumeView& volume, const glm::vec3& position,
                                         const CellLocation& location,
                                         const OutsideHull& outside) noexcept;

}  // namespace tetralight::detail
