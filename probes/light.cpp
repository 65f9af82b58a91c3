// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/light.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace tetralight {
namespace {

float saturate(float value) {
    return std::clamp(value, 0.0f, 1.0f);
}

/// KHR_lights_punctual, "Range Property": the window that takes 1/d² to zero at the range.
float range_window(float ratio) {
    return saturate(1.0f - ratio * ratio * ratio * ratio);
}

/// 1/(1 + 25 x²), and from x² = 0.64 on times a ramp in x² that ends at the range.
float legacy_falloff(float ratio) {
    const float square = ratio * ratio;
    return saturate(1.0f - (square - 0.64f) / 0.36f) / (1.0f + 25.0f * square);
}

/// The falloff with the square of the distance, where the formula divides by one, given apart.
float falloff(const Light& light, float distance, float square) {
    const float ratio = light.range > 0.0f ? distance / light.range : 0.0f;
    switch (light.falloff) {
        case LightFalloff::Linear:
            return saturate(1.0f - ratio);
        case LightFalloff::Legacy:
            return legacy_falloff(ratio);
        case LightFalloff::InverseSquareRange:
            return range_window(ratio) * range_window(ratio) / square;
        case LightFalloff::Gltf:
            break;
    }
    return range_window(ratio) / square;
}

/// KHR_lights_punctual, "Inner and Outer Cone Angles".
float cone_window(const Light& light, float cosine) {
    const float width = std::max(0.001f, light.cos_inner_cone - light.cos_outer_cone);
    const float ramp = saturate((cosine - light.cos_outer_cone) / width);
    return ramp * ramp;
}

}  // namespace

float evaluate_falloff(const Light& light, float distance) noexcept {
    if (light.type == LightType::Directional) return 1.0f;
    return falloff(light, distance, distance * distance);
}

float evaluate_emission_profile(const Light& light, glm::vec3 to_light) noexcept {
    const float cosine = -glm::dot(light.direction, to_light);
    switch (light.type) {
        case LightType::Spot:
            return cone_window(light, cosine);
        case LightType::Rectangle:
        case LightType::Disc:
            return std::max(0.0f, cosine);
        case LightType::Directional:
        case LightType::Point:
            break;
    }
    return 1.0f;
}

float light_area(const Light& light) noexcept {
    if (light.type == LightType::Rectangle) return light.width * light.height;
    if (light.type != LightType::Disc) return 0.0f;
    return std::numbers::pi_v<float> * light.radius * light.radius;
}

Illumination illuminate(const Light& light, glm::vec3 position) noexcept {
    if (light.type == LightType::Directional) {
        return {light.intensity, -light.direction, std::numeric_limits<float>::infinity()};
    }
    const glm::vec3 offset = light.position - position;
    const float distance = glm::length(offset);
    if (!(distance > 0.0f)) return {};
    const glm::vec3 to_light = offset / distance;
    const float square = distance * distance + light_area(light) * std::numbers::inv_pi_v<float>;
    const float share =
        falloff(light, distance, square) * evaluate_emission_profile(light, to_light);
    return {light.intensity * share, to_light, distance};
}

}  // namespace tetralight
