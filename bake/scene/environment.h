// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bake/scene/scene.h"

namespace tetralight {

/// Radiance that arrives from `direction` (a unit vector away from the eye), bilinearly filtered.
[[nodiscard]] glm::vec3 environment_radiance(const Environment& environment, glm::vec3 direction);

}  // namespace tetralight
