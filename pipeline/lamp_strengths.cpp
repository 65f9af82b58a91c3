// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lamp_strengths.h>

#include <algorithm>
#include <glm/common.hpp>
#include <vector>

#include <tetralight/pipeline/bake_key.h>

namespace tetralight {
namespace {

/// True if a layer has light of the sky or of a material.
bool has_other_light(const LightPlan& plan, uint32_t layer) {
    return plan.layer_of_sky == layer ||
           std::ranges::find(plan.layer_of_material, layer) != plan.layer_of_material.end();
}

glm::vec3 divided(const glm::vec3& intensity, float strength) {
    constexpr float kSteps = 4096.0f;
    return glm::round(intensity / strength * kSteps) / kSteps;
}

}  // namespace

Result<LampStrengths> lamp_strengths(Scene scene, const LightingSettings& settings) {
    const auto plan = plan_lighting(scene, settings);
    if (!plan) return plan.error();
    LampStrengths result;
    for (uint32_t layer = 0; layer < plan->bake.layer_count; ++layer) {
        if (has_other_light(plan->bake, layer)) continue;
        std::vector<Light*> lights;
        float strength = 0.0f;
        for (size_t i = 0; i < scene.lights.size(); ++i) {
            if (plan->bake.layer_of(plan->bake.layer_of_light, i) != layer) continue;
            lights.push_back(&scene.lights[i]);
            const glm::vec3& rgb = scene.lights[i].intensity;
            strength = std::max({strength, rgb.r, rgb.g, rgb.b});
        }
        if (strength <= 0.0f) continue;
        for (Light* light : lights) light->intensity = divided(light->intensity, strength);
        result.strengths[plan->layer_names[layer]] = strength;
    }
    result.scene_key = scene_key(scene);
    return result;
}

}  // namespace tetralight
