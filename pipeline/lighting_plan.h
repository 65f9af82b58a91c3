// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/bake/light_plan.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/mixed_lighting.h>

namespace tetralight {

/// How light is shared between the bake and the runtime, and which parts of it can change later.
struct LightingSettings {
    MixedLighting mixed_lighting = MixedLighting::Indirect;
    /// "sun" (all directional lights), "sky", "emission", "light:NAME", "material:NAME", each a
    /// layer of its own; the last two win over the first three. "transfer": how probes answer to
    /// distant light, for layer "sky", which it brings along.
    std::vector<std::string> layers;

    bool operator==(const LightingSettings&) const = default;
};

/// What follows from them for one scene.
struct LightingPlan {
    LightPlan bake;
    /// Of the baked layers; "rest" is the last one when anything else shines in the scene.
    std::vector<std::string> layer_names;
    /// One a light: `Mixed` ones that found no occlusion channel are `Baked` here.
    std::vector<Light> lights;
    std::vector<LightState> light_states;
    /// Lights that fell back, layers that nothing lights.
    std::vector<std::string> warnings;

    [[nodiscard]] bool has_rest() const { return layer_names.size() > bake.layer_count; }
};

/// Errors: a layer that is not one of the words, holds a control character, stands twice, names no
/// light or material of the scene (the message lists what there is) or a light of which nothing is
/// baked; more than 32.
[[nodiscard]] Result<LightingPlan> plan_lighting(const Scene& scene,
                                                 const LightingSettings& settings);

}  // namespace tetralight
