// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/lighting_plan.h>

namespace tetralight {

/// How lightmaps were baked, as a JSON object: generator, key of the scene, settings, and with a
/// shadow mask `shadow_mask`: the name and the channel of each of its lights.
[[nodiscard]] std::string lightmap_metadata(const Scene& scene, const LightingPlan& plan,
                                            const BakeLightmapsSettings& settings);

/// Replaces the time budget of such metadata, which have one, by a number of samples
/// ("max_samples"); 0: it becomes none. The result is that of `lightmap_metadata` for settings with
/// these samples and no time budget.
void set_recorded_samples(std::string& metadata, uint64_t max_samples);

}  // namespace tetralight
