// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/occlusion.h>

#include <algorithm>

#include <tetralight/bake/lights/sample_light.h>
#include <tetralight/bake/sampling/mix.h>

namespace tetralight {
namespace {

/// The light without range, cone and falloff, so that its samples depend on its shape alone.
Light shape_of(Light light) {
    if (light.type == LightType::Spot) light.type = LightType::Point;
    light.intensity = glm::vec3(1.0f);
    light.range = 0.0f;
    light.falloff = LightFalloff::Gltf;
    return light;
}

/// The visibility of the light of each channel, from `visibility(light, key)`.
template <class Visibility>
glm::vec4 channel_visibility(std::span<const Light> lights, const OcclusionLights& channel_lights,
                             uint64_t key, const Visibility& visibility) {
    glm::vec4 occlusion(1.0f);
    for (uint32_t channel = 0; channel < channel_lights.size(); ++channel) {
        if (channel_lights[channel] == kNoIndex) continue;
        const uint64_t light_key = detail::mix(key + (channel + 1) * detail::kGoldenRatio64);
        occlusion[static_cast<int>(channel)] =
            visibility(lights[channel_lights[channel]], light_key);
    }
    return occlusion;
}

}  // namespace

float light_visibility(const PathTracer& tracer, const Light& light, glm::vec3 origin, uint64_t key,
                       uint32_t ray_count) {
    if (!can_have_occlusion(light.type)) return 0.0f;
    const Light shape = shape_of(light);
    const bool is_hard = has_hard_shadows(light) && !tracer.trace_scene().has_blending();
    const uint32_t count = is_hard ? 1 : ray_count;
    uint32_t visible = 0;
    for (uint32_t i = 0; i < count; ++i) {
        Sampler sampler(key, i);
        const LightSample sample = sample_light(shape, origin, sampler.next2());
        visible += !tracer.occluded(origin, sample, sampler.next());
    }
    return static_cast<float>(visible) / static_cast<float>(count);
}

glm::vec4 probe_occlusion(const PathTracer& tracer, std::span<const Light> lights,
                          const OcclusionLights& channel_lights, glm::vec3 origin, uint64_t key) {
    return channel_visibility(lights, channel_lights, key,
                              [&](const Light& light, uint64_t light_key) {
                                  return light_visibility(tracer, light, origin, light_key);
                              });
}

glm::vec4 texel_occlusion(const PathTracer& tracer, std::span<const Light> lights,
                          const OcclusionLights& channel_lights, glm::vec3 position,
                          const TexelSurface& surface, uint64_t key) {
    const auto place_count = static_cast<uint32_t>(surface.origins.size());
    const uint32_t ray_count = std::max(1u, kOcclusionRayCount / place_count);
    const auto visibility = [&](const Light& light, uint64_t light_key) {
        float sum = 0.0f;
        for (uint32_t place = 0; place < place_count; ++place) {
            const uint64_t place_key = place == 0 ? light_key : detail::mix(light_key + place);
            sum += light_visibility(tracer, light, position + surface.origins[place], place_key,
                                    ray_count);
        }
        return sum / static_cast<float>(place_count);
    };
    return channel_visibility(lights, channel_lights, key, visibility);
}

}  // namespace tetralight
