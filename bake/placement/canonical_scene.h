// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// The same scene with its instances, their triangles and its lights in an order that follows from
/// what they are: scenes that differ in order alone become one, and so do the rays and the light
/// that are found in them. Things that move, cameras and probe groups are left out.
[[nodiscard]] Scene canonical_scene(const Scene& scene);

}  // namespace tetralight
