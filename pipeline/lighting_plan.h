// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/bake/light_plan.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/mixed_lighting.h>

namespace tetralight {

/// Which light is baked and which is left to the runtime, and which parts can change after the
/// bake.
struct LightingSettings {
    MixedLighting mixed_lighting = MixedLighting::Indirect;
    /// Each makes one layer: "sun" (all directional lights), "sky", "emission", "light:NAME",
    /// "material:NAME"; the last two take precedence over the first three. "transfer" bakes how
    /// probes respond to distant light; it implies "sky".
    std::vector<std::string> layers;

    bool operator==(const LightingSettings&) const = default;
};

/// The lighting settings applied to one scene.
struct LightingPlan {
    LightPlan bake;
    /// Names of the baked layers. The last is "rest" if the scene has light in no other layer.
    std::vector<std::string> layer_names;
    /// One a light; mixed lights without an occlusion channel are `Baked` here.
    std::vector<Light> lights;
    std::vector<LightState> light_states;
    /// One line for each light without an occlusion channel and for each layer without light.
    std::vector<std::string> warnings;

    [[nodiscard]] bool has_rest() const { return layer_names.size() > bake.layer_count; }
};

/// Returns invalid_argument (field "layers") for a layer that is unknown, contains a control
/// character, is listed twice, or names a realtime light, and for more than 32 layers; not_found
/// for a light or material that the scene does not have (the message lists those that it has).
[[nodiscard]] Result<LightingPlan> plan_lighting(const Scene& scene,
                                                 const LightingSettings& settings);

/// The occlusion channel of each light; kNoIndex: none.
[[nodiscard]] std::vector<uint32_t> channels_of(const std::vector<LightState>& states);

}  // namespace tetralight
