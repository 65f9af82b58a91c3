// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// The same scene with its instances, their triangles and its lights in an order that depends only
/// on their contents: scenes that differ only in order become equal, and so do rays and light in
/// them. Without moving objects, cameras and probe groups.
[[nodiscard]] Scene canonical_scene(const Scene& scene);

}  // namespace tetralight
