// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/punctual_lights.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tetralight {
namespace {

/// Estimate of the irradiance; positive if any part of the disc is above the horizon.
float directional_importance(const Light& sun, const ShadingPoint& shading_point) {
    const float power = power_of(sun.intensity);
    if (shading_point.normal == glm::vec3(0.0f)) return power;
    const float margin = std::sin(std::min(sun.radius, 1.57f)) + 1e-4f;
    return power * std::max(0.0f, margin - glm::dot(shading_point.normal, sun.direction));
}

/// Half extent of the bounding box of a light's shape.
glm::vec3 half_extent(const Light& light) {
    if (light.type != LightType::Rectangle) return glm::vec3(light.radius);
    const glm::vec3 across = glm::cross(light.direction, light.tangent);
    return 0.5f * (glm::abs(light.tangent) * light.width + glm::abs(across) * light.height);
}

}  // namespace

LightBounds light_bounds_of(const Light& light) noexcept {
    LightBounds bounds;
    bounds.min = light.position - half_extent(light);
    bounds.max = light.position + half_extent(light);
    bounds.power = power_of(light.intensity);
    if (light.range > 0.0f) bounds.max_distance = light.range;
    const bool is_inverse_square =
        light.falloff == LightFalloff::Gltf || light.falloff == LightFalloff::InverseSquareRange;
    // Other falloffs are finite at the light: take their value at half the range as the average.
    if (!is_inverse_square && light.range > 0.0f) bounds.power *= 0.25f * light.range * light.range;
    if (light.type == LightType::Point) return bounds;
    bounds.axis = light.direction;
    bounds.cos_theta_o = 1.0f;
    bounds.cos_theta_e = 0.0f;
    if (light.type == LightType::Spot) bounds.cos_theta_e = light.cos_outer_cone;
    return bounds;
}

PunctualLights::PunctualLights(std::span<const Light> lights) {
    std::vector<LightBounds> bounds;
    for (uint32_t i = 0; i < lights.size(); ++i) {
        const Light& light = lights[i];
        if (!(power_of(light.intensity) > 0.0f)) continue;
        if (light.type == LightType::Directional) {
            directional_.push_back(light);
            directional_sources_.push_back(i);
        } else {
            local_.push_back(light);
            local_sources_.push_back(i);
            bounds.push_back(light_bounds_of(light));
        }
    }
    tree_ = LightTree(bounds);
}

std::vector<std::pair<Light, uint32_t>> PunctualLights::directional_lights() const {
    std::vector<std::pair<Light, uint32_t>> lights;
    for (size_t i = 0; i < directional_.size(); ++i) {
        lights.emplace_back(directional_[i], directional_sources_[i]);
    }
    return lights;
}

LightSample PunctualLights::sample_directional(const ShadingPoint& shading_point,
                                               Sampler& sampler) const noexcept {
    float choice = 0.0f;
    if (directional_.size() > 1) {
        choice = sampler.next();
    } else {
        sampler.skip();
    }
    float total = 0.0f;
    for (const Light& sun : directional_) total += directional_importance(sun, shading_point);
    float rest = choice * total;
    for (size_t i = 0; i < directional_.size(); ++i) {
        const Light& sun = directional_[i];
        const float own = directional_importance(sun, shading_point);
        if (!(own > 0.0f)) continue;
        rest -= own;
        if (rest >= 0.0f) continue;
        LightSample sample = sample_light(sun, shading_point.position, sampler.next2());
        if (own != total) sample.irradiance *= total / own;
        sample.source = directional_sources_[i];
        return sample;
    }
    sampler.skip();
    return {};
}

LightSample PunctualLights::sample_local(const ShadingPoint& shading_point,
                                         Sampler& sampler) const noexcept {
    const double choice = sampler.next_double();
    const glm::vec2 u = sampler.next2();
    const auto chosen = tree_.sample(shading_point, choice);
    if (!chosen) return {};
    LightSample sample = sample_light(local_[chosen->light], shading_point.position, u);
    sample.irradiance /= chosen->probability;
    sample.source = local_sources_[chosen->light];
    return sample;
}

}  // namespace tetralight
