// SPDX-License-Identifier: Apache-2.0
#include "probes/light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace tetralight {
namespace {

/// KHR_lights_punctual, "Range Property": the window that takes 1/d² to zero at the range.
float range_window(float distance, float range) {
    if (range <= 0.0f) return 1.0f;
    const float ratio = distance / range;
    return std::clamp(1.0f - ratio * ratio * ratio * ratio, 0.0f, 1.0f);
}

/// KHR_lights_punctual, "Inner and Outer Cone Angles".
float cone_window(const Light& light, glm::vec3 to_light) {
    if (light.type != LightType::Spot) return 1.0f;
    const float cosine = -glm::dot(light.direction, to_light);
    const float width = std::max(0.001f, light.cos_inner_cone - light.cos_outer_cone);
    const float ramp = std::clamp((cosine - light.cos_outer_cone) / width, 0.0f, 1.0f);
    return ramp * ramp;
}

}  // namespace

Illumination illuminate(const Light& light, glm::vec3 position) noexcept {
    if (light.type == LightType::Directional) {
        return {light.intensity, -light.direction, std::numeric_limits<float>::infinity()};
    }
    const glm::vec3 offset = light.position - position;
    const float distance = glm::length(offset);
    if (!(distance > 0.0f)) return {};
    const glm::vec3 to_light = offset / distance;
    const float falloff = range_window(distance, light.range) / (distance * distance);
    return {light.intensity * (falloff * cone_window(light, to_light)), to_light, distance};
}

}  // namespace tetralight
