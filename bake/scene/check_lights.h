// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// What no bake can take: intensities, multipliers and ranges that are negative or not finite
/// (which read_gltf() refuses as well), and names with control characters. Errors name the light
/// and the value.
[[nodiscard]] Status check_lights(const Scene& scene);

}  // namespace tetralight
