// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <tetralight/reflection/reflections.h>

// Places in the axes of a probe's box, in double, so that boxes far from the origin stay exact.

namespace tetralight::detail {

/// A vector in the axes of the box.
[[nodiscard]] inline glm::dvec3 box_from_world(const ReflectionProbe& probe,
                                               const glm::dvec3& vector) noexcept {
    return {glm::dot(vector, glm::dvec3(probe.axes[0])),
            glm::dot(vector, glm::dvec3(probe.axes[1])),
            glm::dot(vector, glm::dvec3(probe.axes[2]))};
}

/// The same vector in the world.
[[nodiscard]] inline glm::dvec3 world_from_box(const ReflectionProbe& probe,
                                               const glm::dvec3& vector) noexcept {
    return vector.x * glm::dvec3(probe.axes[0]) + vector.y * glm::dvec3(probe.axes[1]) +
           vector.z * glm::dvec3(probe.axes[2]);
}

/// A position relative to the center of the box, in its axes.
[[nodiscard]] inline glm::dvec3 place_in_box(const ReflectionProbe& probe,
                                             const glm::dvec3& position) noexcept {
    return box_from_world(probe, position - probe.position - glm::dvec3(probe.box_center));
}

/// Walls on the sides of a box count as inside it, however their positions are rounded: as a
/// multiple of the box.
inline constexpr double kBoxReach = 1.001;

/// Distance from a place outside the box to the box; 0 inside.
[[nodiscard]] inline double distance_to_box(const ReflectionProbe& probe,
                                            const glm::dvec3& place) noexcept {
    const glm::dvec3 beyond = glm::abs(place) - kBoxReach * glm::dvec3(probe.half_size);
    return glm::length(glm::max(beyond, glm::dvec3(0.0)));
}

}  // namespace tetralight::detail
