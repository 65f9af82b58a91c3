// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/path_tracer.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include <tetralight/bake/detail/mis.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/scene/environment.h>

namespace tetralight {

using detail::power_heuristic;

namespace {

/// Share of directions of `sample_start` in proportion to the cosine; the others are uniform.
constexpr float kCosineShare = 0.75f;

/// Russian roulette starts after this many reflections, for paths with a throughput below
/// 1 / kSurvivalPerThroughput. Survivors have that throughput again, so that a path in a closed
/// room continues with the albedo as probability. The values have the least product of variance and
/// rays over the courtyard, Sponza and white rooms (docs/decisions/0048-all-light-by-default.md).
constexpr uint32_t kRouletteStart = 2;
constexpr float kSurvivalPerThroughput = 2.5f;

/// The smallest survival probability: the throughput of a survivor grows at most fourfold.
constexpr float kMinSurvival = 0.25f;

/// The largest one, so that paths end in rooms without absorption too.
constexpr float kMaxSurvival = 0.99f;

float brightest(glm::vec3 c) {
    return std::max({c.r, c.g, c.b});
}

float mean(glm::vec3 c) {
    return (c.r + c.g + c.b) / 3.0f;
}

/// A small weight as a larger one that is mostly 0, so that its rays are saved.
float thin_out(float weight, Sampler& sampler) {
    constexpr float kLeast = 0.25f;
    if (weight >= kLeast) return weight;
    return sampler.next() < weight / kLeast ? kLeast : 0.0f;
}

/// False also for lights so near that their irradiance overflows: their density has no MIS weight.
bool is_light(glm::vec3 irradiance) {
    return brightest(irradiance) > 0.0f && brightest(irradiance) < 1e30f;
}

}  // namespace

float start_pdf(glm::vec3 normal, glm::vec3 direction) noexcept {
    if (normal == glm::vec3(0.0f)) return detail::kSpherePdf;
    const float cosine_pdf = sample_cosine_hemisphere_pdf(normal, direction);
    if (!(cosine_pdf > 0.0f)) return 0.0f;
    return kCosineShare * cosine_pdf + (1.0f - kCosineShare) * 2.0f * detail::kSpherePdf;
}

glm::vec3 sample_start(glm::vec3 normal, glm::vec2 u) noexcept {
    const glm::vec3 direction =
        u.x < kCosineShare
            ? sample_cosine_hemisphere(normal, {u.x / kCosineShare, u.y})
            : sample_cone(normal, 0.0f, {(u.x - kCosineShare) / (1.0f - kCosineShare), u.y});
    const float cosine = glm::dot(normal, direction);
    if (cosine > 0.0f) return direction;
    // Rounded below the horizon, where the density is 0: one sample in 10^8.
    constexpr float kAboveHorizon = 1e-6f;
    return glm::normalize(direction + (kAboveHorizon - cosine) * normal);
}

PathTracer::PathTracer(const Scene& scene, const TraceScene& trace_scene,
                       const PathSettings& settings, const LightPlan& plan,
                       std::vector<Opening> openings, const RadianceCache* cache)
    : scene_(scene),
      trace_scene_(trace_scene),
      settings_(settings),
      plan_(plan),
      light_sampler_(scene, trace_scene) {
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        if (plan.mode_of(scene, i) != LightMode::Baked) continue;
        baked_lights_.push_back(trace_scene.render_from_world(scene.lights[i]));
        layer_of_baked_light_.push_back(plan.layer_of(plan.layer_of_light, i));
    }
    if (!settings.traces_all_light()) return;
    cache_ = cache;
    if (openings.empty()) return;
    std::vector<Light> lights;
    for (const auto& [light, source] : light_sampler_.directional_lights()) {
        lights.push_back(light);
        opening_lights_.push_back(source);
    }
    openings_ = Openings(trace_scene, std::move(openings), std::move(lights));
}

PathSample PathTracer::trace(const PathStart& start, Sampler sampler,
                             PathLightGroups* light_groups) const {
    PathSample sample;
    glm::vec3 reflected(0.0f);
    Path path{sampler, sampler.branch(), glm::vec3(1.0f), 0, light_groups};
    glm::vec3& throughput = path.throughput;
    Ray ray{start.origin, start.direction};
    ShadingPoint shading_point{start.origin, start.normal};
    Draws draws = draws_at(start);
    draws.chance_pdf = start_pdf(start.normal, start.direction);
    float pdf = start.paths_per_light_sample * draws.chance_pdf;
    // Of light that arrives at the start of the segment from its sources.
    float weight = settings_.is_reflected_only ? 0.0f : 1.0f;
    glm::vec3 light_before_last(0.0f);
    if (settings_.bounces == 0) sample.last_throughput = 1.0f;
    for (uint32_t bounce = 0;; ++bounce) {
        const auto arrival =
            bounce == 0 ? PathLightGroups::Arrival::Direct : PathLightGroups::Arrival::Reflected;
        glm::vec3& sum = bounce == 0 ? sample.radiance : reflected;
        const std::optional<Surface> surface =
            bounce == 0 ? first_surface(start, ray, path.ray_count)
                        : next_surface(ray, TraceScene::kDiffuseSpread, path.ray_count);
        if (!surface) {
            const glm::vec3 light = throughput *
                                    environment_radiance(scene_.environment, ray.direction) *
                                    (weight * sky_weight(draws, ray.direction, pdf));
            sum += light;
            path.add(plan_.layer_of_sky, light, arrival);
            if (light_groups != nullptr)
                light_groups->set_escape({ray.direction, throughput, bounce == 0});
            break;
        }
        if (surface->is_back_face) {
            sample.hit_back_face = bounce == 0;
            break;
        }
        if (surface->emission != glm::vec3(0.0f)) {
            const float light_pdf = light_sampler_.pdf(shading_point, *surface);
            const glm::vec3 light =
                throughput * surface->emission * (weight * mis_weight_bsdf(pdf, light_pdf));
            sum += light;
            path.add(layer_of_geometry(surface->geometry), light, arrival);
        }
        throughput *= surface->albedo;  // cosine-weighted: albedo/π · cos θ over cos θ/π
        if (bounce == settings_.bounces) sample.cut_throughput = mean(throughput);
        if (bounce == settings_.bounces || throughput == glm::vec3(0.0f)) break;
        if (bounce >= kRouletteStart) {
            const float survival = std::clamp(kSurvivalPerThroughput * brightest(throughput),
                                              kMinSurvival, kMaxSurvival);
            if (path.sampler.next() >= survival) break;
            throughput /= survival;
        }
        if (bounce + 1 == settings_.bounces) {
            light_before_last = reflected;
            sample.last_throughput = mean(throughput);
        }
        const float drawn = direction_density(draws, ray.direction);
        weight = 1.0f;
        if (drawn > 0.0f) {
            weight = power_heuristic(draws.chance_pdf, drawn);
            if (cache_ == nullptr) weight = thin_out(weight, path.draw_sampler);
        }
        shading_point = {surface->position, surface->geometric_normal};
        const auto texel = cached_texel(*surface, ray.origin);
        if (texel && cache_->has_reflected) {
            reflected += throughput * cached_light(*surface, *texel, path, {weight, 1.0f}, draws);
            break;
        }
        const Draws arrival_draws =
            std::exchange(draws, draws_at(shading_point, std::min(1.0f, brightest(throughput))));
        if (texel) {
            reflected +=
                throughput * cached_light(*surface, *texel, path, {weight, 0.0f}, arrival_draws);
            draws.sees_sky = false;
            weight = 0.0f;
        } else {
            reflected += throughput * reflected_light(*surface, path, weight, arrival_draws, draws);
        }

        ray = {TraceScene::ray_origin(*surface, shading_point.normal),
               sample_cosine_hemisphere(shading_point.normal, path.sampler.next2())};
        pdf = sample_cosine_hemisphere_pdf(shading_point.normal, ray.direction);
        draws.chance_pdf = pdf;
        reflected += drawn_light(draws, ray.origin, path);
    }
    if (sample.last_throughput > 0.0f) sample.last_light = reflected - light_before_last;
    const float brightness = brightest(reflected);
    if (settings_.clamp > 0.0f && brightness > settings_.clamp) {
        reflected *= settings_.clamp / brightness;
        if (light_groups != nullptr) light_groups->scale_reflected(settings_.clamp / brightness);
    }
    sample.radiance += reflected;
    sample.ray_count = path.ray_count;
    return sample;
}

std::optional<Surface> PathTracer::next_surface(const Ray& ray, float spread,
                                                uint32_t& ray_count) const {
    ++ray_count;
    return trace_scene_.intersect(ray, TraceScene::Detail::LightOnly, spread);
}

std::optional<Surface> PathTracer::first_surface(const PathStart& start, Ray& ray,
                                                 uint32_t& ray_count) const {
    auto surface = next_surface(ray, start.spread, ray_count);
    while (surface && start.is_hidden != nullptr && (*start.is_hidden)[surface->instance]) {
        ray.origin = TraceScene::ray_origin(*surface, -surface->geometric_normal);
        surface = next_surface(ray, start.spread, ray_count);
    }
    return surface;
}

std::optional<Surface> PathTracer::first_surface(const PathStart& start,
                                                 uint32_t& ray_count) const {
    Ray ray{start.origin, start.direction};
    return first_surface(start, ray, ray_count);
}

bool PathTracer::can_sample_emission() const {
    return settings_.strategy != LightStrategy::BsdfOnly && !settings_.is_reflected_only &&
           (light_sampler_.has(LightKind::Triangle) || light_sampler_.has(LightKind::Sky));
}

LightSample PathTracer::sample_emission(LightKind kind, const PathStart& start,
                                        Sampler& sampler) const {
    LightSample sample = light_sampler_.sample(kind, {start.origin, start.normal}, sampler);
    float other_pdf = start_pdf(start.normal, sample.to_light);
    if (!(other_pdf > 0.0f)) return {};  // behind the surface
    if (kind == LightKind::Sky && start.opening_weights != nullptr) {
        // Draws are as many as paths.
        other_pdf = std::hypot(other_pdf, direction_density(draws_at(start), sample.to_light));
    }
    other_pdf *= start.paths_per_light_sample;
    sample.irradiance *= mis_weight_light(sample.pdf, other_pdf);
    if (!is_light(sample.irradiance) || occluded(start.origin, sample)) return {};
    return sample;
}

bool PathTracer::occluded(glm::vec3 origin, const LightSample& sample, float blend_seed) const {
    // TraceScene decides by a hash of the ray whether an alpha-blended surface stops it, so that
    // equal rays get equal answers. A hard light always gives the same shadow ray; scaling its
    // direction (and its length back) changes the hash but not the segment, so that each sample
    // makes an independent decision.
    const float scale = 1.0f + blend_seed;
    if (sample.is_distant) return trace_scene_.occluded({origin, sample.to_light * scale});
    return trace_scene_.occluded({origin, (sample.target - origin) * scale, 1.0f / scale});
}

glm::vec3 PathTracer::sampled_irradiance(LightKind kind, const Surface& surface, Path& path,
                                         float weight, const Draws& arrival,
                                         const Draws& here) const {
    if (!light_sampler_.has(kind)) return glm::vec3(0.0f);
    const ShadingPoint shading_point{surface.position, surface.geometric_normal};
    const LightSample sample = light_sampler_.sample(kind, shading_point, path.sampler);
    const float cosine = glm::dot(shading_point.normal, sample.to_light);
    if (cosine <= 0.0f || !is_light(sample.irradiance)) return glm::vec3(0.0f);
    float other_pdf = cosine * std::numbers::inv_pi_v<float>;
    if (kind == LightKind::Sky)
        other_pdf = std::hypot(other_pdf, direction_density(here, sample.to_light));
    if (kind == LightKind::Directional) weight = spot_weight(arrival, surface, sample, weight);
    const float mis = mis_weight_light(sample.pdf, other_pdf) * weight;
    if (mis <= 0.0f) return glm::vec3(0.0f);
    ++path.ray_count;
    if (occluded(TraceScene::ray_origin(surface, shading_point.normal), sample))
        return glm::vec3(0.0f);
    const glm::vec3 light = sample.irradiance * (cosine * mis);
    path.add(layer_of(kind, sample), path.throughput * light * std::numbers::inv_pi_v<float>,
             PathLightGroups::Arrival::Reflected);
    return light;
}

glm::vec3 PathTracer::reflected_light(const Surface& surface, Path& path, float weight,
                                      const Draws& arrival, const Draws& here) const {
    glm::vec3 irradiance(0.0f);
    for (const LightKind kind :
         {LightKind::Directional, LightKind::Local, LightKind::Triangle, LightKind::Sky}) {
        irradiance += sampled_irradiance(kind, surface, path, weight, arrival, here);
    }
    return irradiance * std::numbers::inv_pi_v<float>;
}

std::optional<uint32_t> PathTracer::cached_texel(const Surface& surface, glm::vec3 origin) const {
    return cache_ != nullptr ? cache_->find(surface, origin) : std::nullopt;
}

glm::vec3 PathTracer::cached_light(const Surface& surface, uint32_t texel, Path& path,
                                   CacheWeights weights, const Draws& arrival) const {
    // Draws find the sunlight of spots too. Their weights need the light's direction.
    const bool samples_sun = arrival.spots > 0.0f;
    const auto irradiance = [&](const RadianceCache::Irradiance& cached) {
        const glm::vec3 direct = samples_sun ? cached.sources : cached.direct();
        return weights.reflected * cached.reflected + weights.direct * direct;
    };
    glm::vec3 light = irradiance(cache_->irradiance[texel]);
    if (path.light_groups != nullptr) {
        const auto layers = cache_->layers(texel);
        for (uint32_t layer = 0; layer < layers.size(); ++layer) {
            path.add(layer,
                     path.throughput * irradiance(layers[layer]) * std::numbers::inv_pi_v<float>,
                     PathLightGroups::Arrival::Reflected);
        }
    }
    if (samples_sun)
        light +=
            sampled_irradiance(LightKind::Directional, surface, path, weights.direct, arrival, {});
    return light * std::numbers::inv_pi_v<float>;
}

uint32_t PathTracer::layer_of_geometry(uint32_t geometry) const {
    if (plan_.layer_of_material.empty()) return kNoIndex;
    return plan_.layer_of(plan_.layer_of_material, trace_scene_.material(geometry));
}

uint32_t PathTracer::layer_of(LightKind kind, const LightSample& sample) const {
    switch (kind) {
        case LightKind::Directional:
        case LightKind::Local:
            return plan_.layer_of(plan_.layer_of_light, sample.source);
        case LightKind::Triangle:
            return layer_of_geometry(sample.source);
        case LightKind::Sky:
            break;
    }
    return plan_.layer_of_sky;
}

float PathTracer::mis_weight_light(float light_pdf, float bsdf_pdf) const {
    if (light_pdf == 0.0f) return 1.0f;  // no ray can hit the light
    if (settings_.strategy == LightStrategy::Mis) return power_heuristic(light_pdf, bsdf_pdf);
    return settings_.strategy == LightStrategy::LightOnly ? 1.0f : 0.0f;
}

float PathTracer::mis_weight_bsdf(float bsdf_pdf, float light_pdf) const {
    if (light_pdf == 0.0f || std::isinf(bsdf_pdf)) return 1.0f;
    if (settings_.strategy == LightStrategy::Mis) return power_heuristic(bsdf_pdf, light_pdf);
    return settings_.strategy == LightStrategy::LightOnly ? 0.0f : 1.0f;
}

}  // namespace tetralight
