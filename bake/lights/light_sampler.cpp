// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/light_sampler.h>

#include <tetralight/bake/scene/environment.h>

namespace tetralight {
namespace {

/// All lights, with zero intensity for those without bounced light.
PunctualLights bounced_lights(const Scene& scene, const TraceScene& trace_scene) {
    std::vector<Light> lights;
    for (const Light& light : scene.lights) {
        const bool is_bounced = light.mode == LightMode::Mixed || light.mode == LightMode::Baked;
        lights.push_back(trace_scene.render_from_world(light));
        lights.back().intensity *= is_bounced ? light.indirect_multiplier : 0.0f;
    }
    return PunctualLights(lights);
}

}  // namespace

LightSampler::LightSampler(const Scene& scene, const TraceScene& trace_scene)
    : environment_(scene.environment),
      punctual_lights_(bounced_lights(scene, trace_scene)),
      triangles_(trace_scene),
      sky_(scene.environment) {}

bool LightSampler::has(LightKind kind) const noexcept {
    switch (kind) {
        case LightKind::Directional:
            return punctual_lights_.has_directional();
        case LightKind::Local:
            return punctual_lights_.has_local();
        case LightKind::Triangle:
            return !triangles_.is_empty();
        case LightKind::Sky:
            break;
    }
    return !sky_.is_empty();
}

LightSample LightSampler::sample(LightKind kind, const ShadingPoint& shading_point,
                                 Sampler& sampler) const noexcept {
    switch (kind) {
        case LightKind::Directional:
            return punctual_lights_.sample_directional(shading_point, sampler);
        case LightKind::Local:
            return punctual_lights_.sample_local(shading_point, sampler);
        case LightKind::Triangle: {
            const double choice = sampler.next_double();
            return triangles_.sample(shading_point, choice, sampler.next2());
        }
        case LightKind::Sky:
            break;
    }
    return sample_sky(sampler.next2());
}

LightSample LightSampler::sample_sky(glm::vec2 u) const noexcept {
    LightSample sample;
    sample.is_distant = true;
    sample.to_light = sky_.sample(u);
    sample.pdf = sky_.pdf(sample.to_light);
    if (!(sample.pdf > 0.0f)) return {};
    sample.irradiance = environment_radiance(environment_, sample.to_light) / sample.pdf;
    return sample;
}

}  // namespace tetralight
