// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/plain_tracer.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include <tetralight/verify/plain_directions.h>

namespace tetralight {
namespace {

constexpr float kInversePi = std::numbers::inv_pi_v<float>;
constexpr uint32_t kStrata = 16;
static_assert(kStrata * kStrata == PlainTracer::kBatchSize);

/// Paths of fewer reflections always continue.
constexpr uint32_t kSureReflections = 3;

LightMode mode_of(const Scene& scene, const PlainTracerSettings& settings, size_t light) {
    return settings.light_modes.empty() ? scene.lights[light].mode : settings.light_modes[light];
}

/// Lights whose direct light (`Baked`) or reflected light is in the probes, in render space.
std::vector<Light> lights_in_probes(const Scene& scene, const TraceScene& traced,
                                    const PlainTracerSettings& settings, bool is_direct) {
    std::vector<Light> lights;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const LightMode mode = mode_of(scene, settings, i);
        if (mode == LightMode::Realtime || (is_direct && mode != LightMode::Baked)) continue;
        Light light = traced.render_from_world(scene.lights[i]);
        if (!is_direct) light.intensity *= light.indirect_multiplier;
        if (light.intensity != glm::vec3(0.0f)) lights.push_back(light);
    }
    return lights;
}

}  // namespace

PlainTracer::PlainTracer(const Scene& scene, const TraceScene& traced,
                         const PlainTracerSettings& settings)
    : traced_(traced),
      bounces_(settings.bounces),
      bounced_(lights_in_probes(scene, traced, settings, false)),
      baked_(lights_in_probes(scene, traced, settings, true)),
      emitters_(scene, traced),
      sky_(scene.environment) {}

float PlainTracer::chance_pdf(glm::vec3 normal, glm::vec3 direction) {
    if (normal == glm::vec3(0.0f)) return 0.25f * kInversePi;
    return std::max(0.0f, glm::dot(normal, direction)) * kInversePi;
}

RadianceShSum PlainTracer::trace_batch(glm::vec3 position, Pcg random) const {
    RadianceShSum paths, direct;
    for (uint32_t i = 0; i < kBatchSize; ++i) {
        const glm::vec2 cell(static_cast<float>(i % kStrata), static_cast<float>(i / kStrata));
        const glm::vec3 direction =
            plain_sphere((cell + random.next2()) / static_cast<float>(kStrata));
        paths.add(direction, trace({position, direction}, random));
        add_first_light(position, direct, random);
    }
    RadianceShSum mean;
    for (size_t i = 0; i < mean.coefficients.size(); ++i) {
        mean.coefficients[i] =
            (paths.coefficients[i] * (4.0 * std::numbers::pi) + direct.coefficients[i]) /
            static_cast<double>(kBatchSize);
    }
    return mean;
}

glm::vec3 PlainTracer::trace(Ray ray, Pcg& random) const {
    glm::vec3 radiance(0.0f), throughput(1.0f), normal(0.0f);
    for (uint32_t reflections = 0;; ++reflections) {
        const auto surface = traced_.intersect(ray, TraceScene::Detail::LightOnly);
        const float pdf = chance_pdf(normal, ray.direction);
        if (!surface) {
            const float other = sky_.is_empty() ? 0.0f : sky_.pdf(ray.direction);
            return radiance + throughput * sky_.radiance(ray.direction) * (pdf / (pdf + other));
        }
        if (surface->is_back_face) return radiance;
        if (surface->emission != glm::vec3(0.0f)) {
            const float other = emitters_.pdf(ray.origin, ray.direction, *surface);
            radiance += throughput * surface->emission * (pdf / (pdf + other));
        }
        if (reflections == bounces_) return radiance;
        throughput *= surface->albedo;
        const float brightest = std::max({throughput.x, throughput.y, throughput.z});
        if (!(brightest > 0.0f)) return radiance;
        if (reflections >= kSureReflections) {
            const float survival = std::clamp(brightest, 0.1f, 0.95f);
            if (random.next() >= survival) return radiance;
            throughput /= survival;
        }
        normal = surface->geometric_normal;
        const glm::vec3 origin = TraceScene::ray_origin(*surface, normal);
        radiance += throughput * reflected(*surface, origin, random);
        ray = {origin, plain_hemisphere(normal, random.next2())};
    }
}

glm::vec3 PlainTracer::reflected(const Surface& surface, glm::vec3 origin, Pcg& random) const {
    const glm::vec3 normal = surface.geometric_normal;
    glm::vec3 irradiance(0.0f);
    for (uint32_t i = 0; i < bounced_.draw_count(); ++i) {
        const PlainLightSample light = bounced_.sample(i, surface.position, random);
        const float cosine = glm::dot(normal, light.to_light);
        if (cosine > 0.0f && is_visible(origin, light, random))
            irradiance += cosine * light.irradiance;
    }
    for (const Found& found :
         {find_emitter(origin, normal, random), find_sky(origin, normal, random)}) {
        irradiance += std::max(0.0f, glm::dot(normal, found.direction)) * found.irradiance;
    }
    return irradiance * kInversePi;
}

void PlainTracer::add_first_light(glm::vec3 position, RadianceShSum& sum, Pcg& random) const {
    for (uint32_t i = 0; i < baked_.draw_count(); ++i) {
        const PlainLightSample light = baked_.sample(i, position, random);
        if (is_visible(position, light, random)) sum.add(light.to_light, light.irradiance);
    }
    const glm::vec3 all_around(0.0f);
    for (const Found& found :
         {find_emitter(position, all_around, random), find_sky(position, all_around, random)}) {
        if (found.irradiance != glm::vec3(0.0f)) sum.add(found.direction, found.irradiance);
    }
}

PlainTracer::Found PlainTracer::find_emitter(glm::vec3 origin, glm::vec3 normal,
                                             Pcg& random) const {
    if (emitters_.is_empty()) return {};
    const auto choice = emitters_.sample(origin, random);
    const float chance = chance_pdf(normal, choice.direction);
    if (!(chance > 0.0f) || choice.direction == glm::vec3(0.0f)) return {};
    const auto surface =
        traced_.intersect({origin, choice.direction}, TraceScene::Detail::LightOnly);
    if (!surface || surface->is_back_face) return {};
    if (!PlainEmitters::is_chosen(choice, origin, *surface)) return {};
    const float pdf = emitters_.pdf(origin, choice.direction, *surface);
    return {choice.direction, surface->emission / (pdf + chance)};
}

PlainTracer::Found PlainTracer::find_sky(glm::vec3 origin, glm::vec3 normal, Pcg& random) const {
    if (sky_.is_empty()) return {};
    const glm::vec3 direction = sky_.sample(random);
    const float chance = chance_pdf(normal, direction);
    if (!(chance > 0.0f)) return {};
    const float pdf = sky_.pdf(direction);
    if (!(pdf > 0.0f) || traced_.occluded({origin, direction})) return {};
    return {direction, sky_.radiance(direction) / (pdf + chance)};
}

/// Half-transparent surfaces decide by the bits of a ray whether they stop it: a random length of
/// the direction makes the decisions of equal rays independent.
bool PlainTracer::is_visible(glm::vec3 origin, const PlainLightSample& sample, Pcg& random) const {
    if (sample.irradiance == glm::vec3(0.0f)) return false;
    const float length = 1.0f + random.next();
    return !traced_.occluded({origin, sample.to_light * length, sample.distance / length});
}

}  // namespace tetralight
