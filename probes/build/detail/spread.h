// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// The dimension of a set of positions, and the line and plane that fit it best.
struct Spread {
    Dimension dimension = Dimension::None;
    glm::dvec3 line{0.0};    ///< unit direction of the largest extent
    glm::dvec3 normal{0.0};  ///< unit normal of the plane through it and the largest width

    /// As `VolumeInfo::axis`.
    [[nodiscard]] glm::dvec3 axis() const;
};

/// The lowest dimension of which no position is farther away than `flatness`, or than rounding of
/// the positions can put it.
[[nodiscard]] Spread measure_spread(std::span<const glm::dvec3> positions, double flatness);

/// The numbers of the positions in the order in which they lie along a direction.
[[nodiscard]] std::vector<uint32_t> order_along(std::span<const glm::dvec3> positions,
                                                const glm::dvec3& direction);

/// Positions seen along a unit normal, in a right-handed frame (u, v, normal).
[[nodiscard]] std::vector<glm::dvec2> project(std::span<const glm::dvec3> positions,
                                              const glm::dvec3& normal);

}  // namespace tetralight::detail
