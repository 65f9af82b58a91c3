// SPDX-License-Identifier: Apache-2.0
// The part of the path tracer that draws light from openings.
#include <tetralight/bake/path_tracer.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/bake/detail/mis.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/scene/environment.h>

namespace tetralight {

using detail::power_heuristic;

PathTracer::Draws PathTracer::draws_at(const PathStart& start) const {
    if (start.opening_weights == nullptr) return {};
    Draws draws = draws_with({start.origin, start.normal}, *start.opening_weights, 1.0f);
    draws.is_first = true;
    draws.sees_sky = !settings_.is_reflected_only;
    return draws;
}

/// Density of a direction among those that are not drawn.
float PathTracer::chance_pdf(const Draws& draws, glm::vec3 direction) {
    if (draws.is_first) return start_pdf(draws.from.normal, direction);
    return sample_cosine_hemisphere_pdf(draws.from.normal, direction);
}

PathTracer::Draws PathTracer::draws_at(const ShadingPoint& shading_point, float count) const {
    if (openings_.is_empty()) return {};
    return draws_with(shading_point, openings_.weights(shading_point), count);
}

PathTracer::Draws PathTracer::draws_with(const ShadingPoint& shading_point,
                                         const Openings::Weights& weights, float count) {
    Draws draws;
    draws.from = shading_point;
    draws.weights = weights;
    if (draws.weights.opening_sum > 0.0f) draws.directions = count;
    if (draws.weights.spot_sum > 0.0f) draws.spots = count;
    return draws;
}

float PathTracer::direction_density(const Draws& draws, glm::vec3 direction) const {
    if (!(draws.directions > 0.0f)) return 0.0f;
    return draws.directions *
           openings_.direction_pdf(draws.weights, draws.from.position, direction);
}

float PathTracer::spot_density(const Draws& draws, const Surface& surface,
                               const LightSample& sample) const {
    if (!(draws.spots > 0.0f)) return 0.0f;
    const auto it = std::ranges::find(opening_lights_, sample.source);
    if (it == opening_lights_.end()) return 0.0f;
    const float density = openings_.entrance_density(
        draws.weights, static_cast<uint32_t>(it - opening_lights_.begin()), surface.position,
        sample.to_light);
    const glm::vec3 offset = surface.position - draws.from.position;
    const float distance2 = glm::dot(offset, offset);
    const float facing =
        std::abs(glm::dot(surface.geometric_normal, offset)) / std::sqrt(distance2);
    if (!(density > 0.0f) || !(facing > 0.0f)) return 0.0f;
    const float cosine = glm::dot(surface.geometric_normal, sample.to_light);
    return draws.spots * density * cosine * distance2 / facing;
}

/// The weight of a light sample at a surface that a path has reached: `weight`, or if the sample is
/// in a spot, that of the direction to the surface against all other techniques.
float PathTracer::spot_weight(const Draws& draws, const Surface& surface, const LightSample& sample,
                              float weight) const {
    const float spot = spot_density(draws, surface, sample);
    if (!(spot > 0.0f)) return weight;
    const glm::vec3 direction = glm::normalize(surface.position - draws.from.position);
    const float drawn = direction_density(draws, direction);
    return draws.is_drawn ? power_heuristic(drawn, draws.chance_pdf, spot)
                          : power_heuristic(draws.chance_pdf, drawn, spot);
}

float PathTracer::sky_weight(const Draws& draws, glm::vec3 direction, float pdf) const {
    const float light_pdf = light_sampler_.pdf(direction);
    const float drawn = direction_density(draws, direction);
    if (!(drawn > 0.0f)) return mis_weight_bsdf(pdf, light_pdf);
    // Light samples at the start of a path are relative to `pdf`, draws to `chance_pdf`.
    const float light = std::isinf(pdf) ? 0.0f : light_pdf * draws.chance_pdf / pdf;
    return power_heuristic(draws.chance_pdf, drawn, light);
}

glm::vec3 PathTracer::reflected_by_chance(const Surface& surface, Path& path) const {
    const ShadingPoint shading_point{surface.position, surface.geometric_normal};
    const Ray ray{TraceScene::ray_origin(surface, shading_point.normal),
                  sample_cosine_hemisphere(shading_point.normal, path.sampler.next2())};
    const float pdf = sample_cosine_hemisphere_pdf(shading_point.normal, ray.direction);
    ++path.ray_count;
    const auto hit =
        trace_scene_.intersect(ray, TraceScene::Detail::LightOnly, TraceScene::kDiffuseSpread);
    glm::vec3 light(0.0f);
    uint32_t layer = kNoIndex;
    if (!hit) {
        light = environment_radiance(scene_.environment, ray.direction) *
                mis_weight_bsdf(pdf, light_sampler_.pdf(ray.direction));
        layer = plan_.layer_of_sky;
    } else if (!hit->is_back_face) {
        light = hit->emission * mis_weight_bsdf(pdf, light_sampler_.pdf(shading_point, *hit));
        layer = layer_of_geometry(hit->geometry);
    }
    light *= path.throughput;
    path.add(layer, light, PathLightGroups::Arrival::Reflected);
    return light;
}

PathTracer::OpeningSample PathTracer::draw_direction(const Draws& draws, glm::vec3 ray_origin,
                                                     float light_samples, Path& path) const {
    const float choice = path.draw_sampler.next();
    OpeningSample sample;
    sample.to_light = openings_.sample_direction(draws.weights, draws.from.position, choice,
                                                 path.draw_sampler.next2());
    const float by_chance = chance_pdf(draws, sample.to_light);
    const float drawn = direction_density(draws, sample.to_light);
    if (!(by_chance > 0.0f) || !(drawn > 0.0f)) return sample;
    // Radiance times cosine / π at surfaces, whose albedo is in the throughput of the path.
    const float factor = (draws.is_first ? 1.0f : by_chance) / drawn;
    ++path.ray_count;
    const auto surface = trace_scene_.intersect(
        {ray_origin, sample.to_light}, TraceScene::Detail::LightOnly, TraceScene::kDiffuseSpread);
    if (!surface) {
        if (!draws.sees_sky) return sample;
        const float light_pdf = light_sampler_.pdf(sample.to_light) * light_samples;
        const float weight = power_heuristic(drawn, by_chance, light_pdf);
        sample.irradiance = path.throughput *
                            environment_radiance(scene_.environment, sample.to_light) *
                            (factor * weight);
        path.add(plan_.layer_of_sky, sample.irradiance, PathLightGroups::Arrival::Reflected);
        return sample;
    }
    if (surface->is_back_face) return sample;
    // The surface's direct light, as a path has it that comes by chance.
    const float weight = power_heuristic(drawn, by_chance);
    Path branch{path.draw_sampler, path.draw_sampler.branch(),
                path.throughput * surface->albedo * factor, path.ray_count, path.light_groups};
    Draws arrival = draws;
    arrival.chance_pdf = by_chance;
    arrival.is_drawn = true;
    if (const auto texel = cached_texel(*surface, ray_origin)) {
        sample.irradiance =
            branch.throughput * cached_light(*surface, *texel, branch, {weight, 0.0f}, arrival);
    } else {
        sample.irradiance =
            branch.throughput * reflected_light(*surface, branch, weight, arrival, {});
        branch.throughput *= weight;
        sample.irradiance += reflected_by_chance(*surface, branch);
    }
    path.ray_count = branch.ray_count;
    path.draw_sampler = branch.sampler;
    return sample;
}

PathTracer::OpeningSample PathTracer::draw_spot(const Draws& draws, glm::vec3 ray_origin,
                                                Path& path) const {
    OpeningSample sample;
    const float choice = path.draw_sampler.next();
    const Openings::Entrance entrance =
        openings_.sample_entrance(draws.weights, choice, path.draw_sampler.next2());
    LightSample light =
        sample_light(openings_.light(entrance.light), entrance.position, path.draw_sampler.next2());
    light.source = opening_lights_[entrance.light];
    ++path.ray_count;
    const auto surface =
        trace_scene_.intersect({entrance.position, -light.to_light}, TraceScene::Detail::LightOnly,
                               TraceScene::kDiffuseSpread);
    if (!surface || surface->is_back_face) return sample;
    const float cosine = glm::dot(surface->geometric_normal, light.to_light);
    const glm::vec3 target = TraceScene::ray_origin(*surface, surface->geometric_normal);
    sample.to_light = glm::normalize(target - draws.from.position);
    if (cosine <= 0.0f || glm::dot(surface->geometric_normal, sample.to_light) >= 0.0f)
        return sample;
    const float by_chance = chance_pdf(draws, sample.to_light);
    const float spot = spot_density(draws, *surface, light);
    if (!(by_chance > 0.0f) || !(spot > 0.0f)) return sample;
    ++path.ray_count;
    if (trace_scene_.occluded({ray_origin, target - ray_origin, 1.0f})) return sample;
    ++path.ray_count;
    if (trace_scene_.occluded({entrance.position, light.to_light})) return sample;
    const float weight =
        power_heuristic(spot, by_chance, direction_density(draws, sample.to_light));
    sample.irradiance = path.throughput * surface->albedo * light.irradiance *
                        (cosine * std::numbers::inv_pi_v<float> *
                         (draws.is_first ? 1.0f : by_chance) * weight / spot);
    path.add(layer_of(LightKind::Directional, light), sample.irradiance,
             PathLightGroups::Arrival::Reflected);
    return sample;
}

glm::vec3 PathTracer::drawn_light(const Draws& draws, glm::vec3 ray_origin, Path& path) const {
    glm::vec3 light(0.0f);
    if (!(draws.directions > 0.0f || draws.spots > 0.0f)) return light;
    const float chance = path.draw_sampler.next();
    if (chance < draws.directions)
        light += draw_direction(draws, ray_origin, 1.0f, path).irradiance;
    if (chance < draws.spots) light += draw_spot(draws, ray_origin, path).irradiance;
    return light;
}

std::array<PathTracer::OpeningSample, 2> PathTracer::draw_from_openings(
    const PathStart& start, float light_samples, Sampler sampler,
    std::array<PathLightGroups*, 2> light_groups, uint64_t& ray_count) const {
    std::array<OpeningSample, 2> samples;
    const Draws draws = draws_at(start);
    Path path{sampler, sampler, glm::vec3(1.0f), 0, light_groups[0]};
    if (draws.directions > 0.0f)
        samples[0] = draw_direction(draws, start.origin, light_samples, path);
    path.light_groups = light_groups[1];
    if (draws.spots > 0.0f) samples[1] = draw_spot(draws, start.origin, path);
    ray_count += path.ray_count;
    return samples;
}

}  // namespace tetralight
