// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Returns invalid_argument, with the field `lights[2].range`, if an intensity, a multiplier, a
/// radius or a range is negative or not finite (which read_gltf() refuses as well), or if a name
/// has control characters.
[[nodiscard]] Status check_lights(const Scene& scene);

}  // namespace tetralight
