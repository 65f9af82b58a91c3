// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// `direction` rotated by `angle_radians` about +Y, counter-clockwise seen from above.
[[nodiscard]] glm::vec3 rotated_about_y(glm::vec3 direction, float angle_radians);

/// Radiance that arrives from `direction` (a unit vector away from the point), bilinearly filtered.
[[nodiscard]] glm::vec3 environment_radiance(const Environment& environment, glm::vec3 direction);

}  // namespace tetralight
