// SPDX-License-Identifier: Apache-2.0
#include "bake/emitters.h"

#include "bake/scene/environment.h"

namespace tetralight {
namespace {

/// All lights, those that do not bounce without intensity.
Lamps bounced_lamps(const Scene& scene, const TraceScene& traced) {
    std::vector<Light> lights;
    for (const Light& light : scene.lights) {
        const bool is_bounced = light.mode == LightMode::Mixed || light.mode == LightMode::Baked;
        lights.push_back(traced.traced_from_world(light));
        lights.back().intensity *= is_bounced ? light.indirect_multiplier : 0.0f;
    }
    return Lamps(lights);
}

}  // namespace

Emitters::Emitters(const Scene& scene, const TraceScene& traced)
    : environment_(scene.environment),
      lamps_(bounced_lamps(scene, traced)),
      triangles_(traced),
      sky_(scene.environment) {}

bool Emitters::has(EmitterKind kind) const noexcept {
    switch (kind) {
        case EmitterKind::Sun:
            return lamps_.has_suns();
        case EmitterKind::Lamp:
            return lamps_.has_local();
        case EmitterKind::Triangle:
            return !triangles_.is_empty();
        case EmitterKind::Sky:
            break;
    }
    return !sky_.is_empty();
}

LightSample Emitters::sample(EmitterKind kind, const Receiver& receiver,
                             PathNumbers& numbers) const noexcept {
    switch (kind) {
        case EmitterKind::Sun:
            return lamps_.sample_sun(receiver, numbers);
        case EmitterKind::Lamp:
            return lamps_.sample_local(receiver, numbers);
        case EmitterKind::Triangle: {
            const double choice = numbers.next_fine();
            return triangles_.sample(receiver, choice, numbers.next2());
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
