// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/pipeline/bake_lightmaps.h>

namespace tetralight {

/// How lightmaps were baked, as a JSON object: generator, key of the scene, and settings.
[[nodiscard]] std::string lightmap_metadata(const Scene& scene,
                                            const BakeLightmapsSettings& settings);

}  // namespace tetralight
