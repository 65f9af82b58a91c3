// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/bake/scene/gltf_builder.h"

namespace tetralight::fuzz {

/// A glTF scene that has a little of everything that is read: triangles, strips, fans, points,
/// sparse accessors, materials with PNG, JPEG and WebP images, instances, lights, a sky, cameras,
/// an animation, a skin, and the extras of nodes.
[[nodiscard]] GltfBuilder sound_scene();

}  // namespace tetralight::fuzz
