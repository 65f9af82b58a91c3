// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/emitters.h>

#include <tetralight/bake/scene/environment.h>

namespace tetralight {
namespace {

/// All lights, those that do not bounce without intensity.
PunctualLights bounced_lights(const Scene& scene, const TraceScene& traced) {
    std::vector<Light> lights;
    for (const Light& light : scene.lights) {
        const bool is_bounced = light.mode == LightMode::Mixed || light.mode == LightMode::Baked;
        lights.push_back(traced.render_from_world(light));
        lights.back().intensity *= is_bounced ? light.indirect_multiplier : 0.0f;
    }
    return PunctualLights(lights);
}

}  // namespace

Emitters::Emitters(const Scene& scene, const TraceScene& traced)
    : environment_(scene.environment),
      punctual_lights_(bounced_lights(scene, traced)),
      triangles_(traced),
      sky_(scene.environment) {}

bool Emitters::has(EmitterKind kind) const noexcept {
    switch (kind) {
        case EmitterKind::Sun:
            return punctual_lights_.has_suns();
        case EmitterKind::PunctualLight:
            return punctual_lights_.has_local();
        case EmitterKind::Triangle:
            return !triangles_.is_empty();
        case EmitterKind::Sky:
            break;
    }
    return !sky_.is_empty();
}

LightSample Emitters::sample(EmitterKind kind, const ShadingPoint& shading_point,
                             Sampler& numbers) const noexcept {
    switch (kind) {
        case EmitterKind::Sun:
            return punctual_lights_.sample_sun(shading_point, numbers);
        case EmitterKind::PunctualLight:
            return punctual_lights_.sample_local(shading_point, numbers);
        case EmitterKind::Triangle: {
            const double choice = numbers.next_fine();
            return triangles_.sample(shading_point, choice, numbers.next2());
        }
        case EmitterKind::Sky:
            break;
    }
    return sample_sky(numbers.next2());
}

LightSample Emitters::sample_sky(glm::vec2 u) const noexcept {
    LightSample sample;
    sample.is_distant = true;
    sample.to_light = sky_.sample(u);
    sample.pdf = sky_.pdf(sample.to_light);
    if (!(sample.pdf > 0.0f)) return {};
    sample.irradiance = environment_radiance(environment_, sample.to_light) / sample.pdf;
    return sample;
}

}  // namespace tetralight
