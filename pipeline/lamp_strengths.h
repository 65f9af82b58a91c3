// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/lighting_plan.h>

// A layer that holds lamps alone is proportional to their strength: when nothing else of a scene
// changed, its weight is all that an earlier bake needs.

namespace tetralight {

/// What differs between scenes that one bake serves, and what does not.
struct LampStrengths {
    /// The largest channel of the intensities of the lights of each layer that holds lights alone,
    /// by the name of the layer. Layers that are dark are not among them.
    std::map<std::string, double> strengths;
    /// Hash of the scene with these intensities divided by their strength, and rounded to 1/4096 so
    /// that the division does not change it.
    uint64_t scene_key = 0;
};

/// Returns the errors of `plan_lighting`.
[[nodiscard]] Result<LampStrengths> lamp_strengths(Scene scene, const LightingSettings& settings);

}  // namespace tetralight
