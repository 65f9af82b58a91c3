// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/probes/light.h>

// Where a light can light anything: a ball of its range, a cone of it for spots, everywhere for
// suns and for lights without a range.

namespace tetralight {

/// Whether the volumes of two lights may have a point in common. Never false when they have; true
/// for some that only come near each other.
[[nodiscard]] bool may_overlap(const Light& a, const Light& b) noexcept;

/// Metres from a position to a light's volume: not more than it is, negative inside.
[[nodiscard]] float distance_to_volume(const Light& light, const glm::dvec3& position) noexcept;

}  // namespace tetralight
