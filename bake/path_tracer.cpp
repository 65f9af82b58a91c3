// SPDX-License-Identifier: Apache-2.0
#include "bake/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bake/sampling.h"
#include "bake/scene/environment.h"

namespace tetralight {
namespace {

/// Paths may be ended at random from their third reflection on, when they carry less than half of
/// the light that arrives at their end.
constexpr uint32_t kFirstRoulette = 2;
constexpr float kSurvivalPerThroughput = 2.0f;

/// The least chance to go on: a path that survives grows at most tenfold.
constexpr float kLeastSurvival = 0.1f;

float brightest(glm::vec3 c) {
    return std::max({c.r, c.g, c.b});
}

/// Power heuristic of two techniques, whose densities may be far apart or infinite.
float power_heuristic(float pdf, float other_pdf) {
    if (std::isinf(pdf)) return 1.0f;
    const float ratio = other_pdf / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

/// Emitters so near that their light overflows are left out: no density is left to weigh them by.
bool is_light(glm::vec3 irradiance) {
    return brightest(irradiance) > 0.0f && brightest(irradiance) < 1e30f;
}

}  // namespace

PathTracer::PathTracer(const Scene& scene, const TraceScene& traced, const PathSettings& settings)
    : scene_(scene), traced_(traced), settings_(settings), emitters_(scene, traced) {
    for (const Light& light : scene.lights) {
        if (light.mode == LightMode::Baked)
            baked_lights_.push_back(traced.traced_from_world(light));
    }
}

PathSample PathTracer::trace(const PathStart& start, PathNumbers numbers) const {
    PathSample sample;
    glm::vec3 reflected(0.0f);
    glm::vec3 throughput(1.0f);
    Ray ray{start.origin, start.direction};
    Receiver receiver{start.origin};
    float pdf = start.pdf;
    for (uint32_t bounce = 0;; ++bounce) {
        glm::vec3& sum = bounce == 0 ? sample.radiance : reflected;
        ++sample.ray_count;
        const std::optional<Surface> surface = traced_.cast(ray, TraceScene::Detail::LightOnly);
        if (!surface) {
            const glm::vec3 sky = environment_radiance(scene_.environment, ray.direction);
            sum += throughput * sky * weight_of_met(pdf, emitters_.pdf(ray.direction));
            break;
        }
        if (surface->is_back_face) {
            sample.is_behind_surface = bounce == 0;
            break;
        }
        if (surface->emission != glm::vec3(0.0f)) {
            const float weight = weight_of_met(pdf, emitters_.pdf(receiver, *surface));
            sum += throughput * surface->emission * weight;
        }
        throughput *= surface->albedo;  // cosine-weighted: albedo/π · cos θ over cos θ/π
        if (bounce == settings_.bounces || throughput == glm::vec3(0.0f)) break;
        if (bounce >= kFirstRoulette) {
            const float survival =
                std::max(kLeastSurvival, kSurvivalPerThroughput * brightest(throughput));
            if (survival < 1.0f) {
                if (numbers.next() >= survival) break;
                throughput /= survival;
            }
        }
        reflected += throughput * reflected_light(*surface, numbers, sample.ray_count);

        receiver = {surface->position, surface->geometric_normal};
        ray = {TraceScene::ray_origin(*surface, receiver.normal),
               sample_cosine_hemisphere(receiver.normal, numbers.next2())};
        pdf = sample_cosine_hemisphere_pdf(receiver.normal, ray.direction);
    }
    const float brightness = brightest(reflected);
    if (settings_.clamp > 0.0f && brightness > settings_.clamp) {
        reflected *= settings_.clamp / brightness;
    }
    sample.radiance += reflected;
    return sample;
}

bool PathTracer::can_sample_emission() const {
    return settings_.strategy != LightStrategy::Directions &&
           (emitters_.has(EmitterKind::Triangle) || emitters_.has(EmitterKind::Sky));
}

LightSample PathTracer::sample_emission(EmitterKind kind, const Receiver& receiver, float other_pdf,
                                        PathNumbers& numbers) const {
    LightSample sample = emitters_.sample(kind, receiver, numbers);
    sample.irradiance *= weight_of_drawn(sample.pdf, other_pdf);
    if (!is_light(sample.irradiance) || is_blocked(receiver.position, sample)) return {};
    return sample;
}

bool PathTracer::is_blocked(glm::vec3 origin, const LightSample& sample, float blend) const {
    // What is transparent is drawn by the bits of the ray: another length is another draw.
    const float scale = 1.0f + blend;
    if (sample.is_distant) return traced_.is_blocked({origin, sample.to_light * scale});
    return traced_.is_blocked({origin, (sample.target - origin) * scale, 1.0f / scale});
}

glm::vec3 PathTracer::reflected_light(const Surface& surface, PathNumbers& numbers,
                                      uint32_t& ray_count) const {
    const Receiver receiver{surface.position, surface.geometric_normal};
    const glm::vec3 ray_origin = TraceScene::ray_origin(surface, receiver.normal);
    glm::vec3 irradiance(0.0f);
    for (const EmitterKind kind :
         {EmitterKind::Sun, EmitterKind::Lamp, EmitterKind::Triangle, EmitterKind::Sky}) {
        if (!emitters_.has(kind)) continue;
        const LightSample sample = emitters_.sample(kind, receiver, numbers);
        const float cosine = glm::dot(receiver.normal, sample.to_light);
        if (cosine <= 0.0f || !is_light(sample.irradiance)) continue;
        const float weight = weight_of_drawn(sample.pdf, cosine * std::numbers::inv_pi_v<float>);
        if (weight <= 0.0f) continue;
        ++ray_count;
        if (!is_blocked(ray_origin, sample)) irradiance += sample.irradiance * (cosine * weight);
    }
    return irradiance * std::numbers::inv_pi_v<float>;
}

float PathTracer::weight_of_drawn(float pdf, float other_pdf) const {
    if (pdf == 0.0f) return 1.0f;  // no ray meets it
    if (settings_.strategy == LightStrategy::Both) return power_heuristic(pdf, other_pdf);
    return settings_.strategy == LightStrategy::Emitters ? 1.0f : 0.0f;
}

float PathTracer::weight_of_met(float pdf, float emitter_pdf) const {
    if (emitter_pdf == 0.0f || std::isinf(pdf)) return 1.0f;
    if (settings_.strategy == LightStrategy::Both) return power_heuristic(pdf, emitter_pdf);
    return settings_.strategy == LightStrategy::Emitters ? 0.0f : 1.0f;
}

}  // namespace tetralight
