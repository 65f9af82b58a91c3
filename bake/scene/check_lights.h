// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bake/scene/scene.h"
#include "base/result.h"

namespace tetralight {

/// What read_gltf() refuses in lights, for scenes made by hand: intensities, multipliers and ranges
/// that are negative or not finite. Errors name the light and the value.
[[nodiscard]] Status check_lights(const Scene& scene);

}  // namespace tetralight
