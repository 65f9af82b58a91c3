// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/probes/light.h>

// The volume of a light: the region that it can light. A sphere of its range, cut by its cone for
// spots; all of space for directional lights; unlimited in distance for lights without a range.

namespace tetralight {

/// True if the volumes of two lights may intersect. Conservative: always true if they do, and also
/// for some that are merely close to each other.
[[nodiscard]] bool may_overlap(const Light& a, const Light& b) noexcept;

/// Lower bound of the distance from a position to the volume of a light, metres; negative inside.
[[nodiscard]] float distance_to_volume(const Light& light, const glm::dvec3& position) noexcept;

}  // namespace tetralight
