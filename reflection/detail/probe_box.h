// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
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

/// A position relative to the center of the box, in its axes.
[[nodiscard]] inline glm::dvec3 place_in_box(const ReflectionProbe& probe,
                                             const glm::dvec3& position) noexcept {
    return box_from_world(probe, position - probe.position - glm::dvec3(probe.box_center));
}

/// Distance from a place inside the box to its nearest side; negative outside.
[[nodiscard]] inline double depth_in_box(const ReflectionProbe& probe,
                                         const glm::dvec3& place) noexcept {
    const glm::dvec3 depth = glm::dvec3(probe.half_size) - glm::abs(place);
    return std::min({depth.x, depth.y, depth.z});
}

}  // namespace tetralight::detail
