// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/sample_light.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/sampling/spherical_rectangle.h>

namespace tetralight {
namespace {

/// Below this solid angle, in steradians, a rectangle is sampled by area: the density is nearly the
/// same, and the angles between its edges lose precision.
constexpr double kTinySolidAngle = 1e-4;

/// The light of one point of an area light at a position: intensity and falloff, without the
/// cosine.
Illumination illuminate_from(Light light, glm::vec3 source, glm::vec3 position) {
    light.type = LightType::Point;
    light.position = source;
    return illuminate(light, position);
}

/// A cone of half angle a with radiance L gives a facing surface E = π L sin² a, and a sample
/// stands for 2π (1 − cos a) L. Their ratio is 2 / (1 + cos a), relative to E.
float cone_weight(float cosine) {
    return 2.0f / (1.0f + cosine);
}

LightSample sample_directional(const Light& light, glm::vec2 u) {
    LightSample sample{light.intensity, -light.direction};
    sample.is_distant = true;
    if (light.radius <= 0.0f) return sample;
    const float cosine = std::cos(std::min(light.radius, 0.5f * std::numbers::pi_v<float>));
    sample.to_light = sample_cone(-light.direction, cosine, u);
    sample.irradiance *= cone_weight(cosine);
    return sample;
}

LightSample sample_sphere(const Light& light, glm::vec3 position, glm::vec2 u) {
    const Illumination arriving = illuminate(light, position);
    LightSample sample{arriving.irradiance, arriving.to_light, light.position};
    if (light.radius <= 0.0f || arriving.irradiance == glm::vec3(0.0f)) return sample;
    const float d = arriving.distance;
    const float r = std::min(light.radius, d);
    const float cosine = std::sqrt(std::max(0.0f, 1.0f - r * r / (d * d)));
    sample.to_light = sample_cone(arriving.to_light, cosine, u);
    sample.irradiance *= cone_weight(cosine);
    const float along = d * glm::dot(sample.to_light, arriving.to_light);
    const float inside = std::sqrt(std::max(0.0f, r * r - (d * d - along * along)));
    sample.target = position + (along - inside) * sample.to_light;
    return sample;
}

/// Light of the point `source` of an area light, whose irradiance is the mean of intensity ·
/// falloff · cosine over its area. `weight`: the cosine divided by density · area.
LightSample light_of_point(const Light& light, glm::vec3 source, glm::vec3 position,
                           double weight) {
    const Illumination arriving = illuminate_from(light, source, position);
    return {arriving.irradiance * static_cast<float>(weight), arriving.to_light, source};
}

/// A point sampled uniformly by area.
LightSample light_of_uniform_point(const Light& light, glm::vec3 source, glm::vec3 position) {
    const glm::vec3 offset = position - source;
    const float cosine = glm::dot(light.direction, offset) / glm::length(offset);
    return cosine > 0.0f ? light_of_point(light, source, position, cosine) : LightSample{};
}

LightSample sample_rectangle(const Light& light, glm::vec3 position, glm::vec2 u) {
    if (glm::dot(light.direction, position - light.position) <= 0.0f) return {};
    const glm::vec3 along = light.tangent * light.width;
    const glm::vec3 across = glm::cross(light.direction, light.tangent) * light.height;
    const glm::vec3 corner = light.position - 0.5f * (along + across);
    const SphericalRectangle spherical(corner, along, across, position);
    if (!(spherical.solid_angle() > kTinySolidAngle)) {
        return light_of_uniform_point(light, corner + u.x * along + u.y * across, position);
    }
    // Uniform by solid angle: the density on the light is cos / (d² Ω) instead of 1 / area.
    const glm::vec3 source = spherical.sample(u);
    const double area = static_cast<double>(light.width) * light.height;
    const double d = glm::length(source - position);
    return light_of_point(light, source, position, d * d * spherical.solid_angle() / area);
}

LightSample sample_disc(const Light& light, glm::vec3 position, glm::vec2 u) {
    const glm::vec3 offset = sample_disc_around(light.direction, u) * light.radius;
    return light_of_uniform_point(light, light.position + offset, position);
}

}  // namespace

LightSample sample_light(const Light& light, glm::vec3 position, glm::vec2 u) noexcept {
    switch (light.type) {
        case LightType::Directional:
            return sample_directional(light, u);
        case LightType::Point:
        case LightType::Spot:
            return sample_sphere(light, position, u);
        case LightType::Rectangle:
            return sample_rectangle(light, position, u);
        case LightType::Disc:
            break;
    }
    return sample_disc(light, position, u);
}

bool has_hard_shadows(const Light& light) noexcept {
    return light.type == LightType::Rectangle ? light.width <= 0.0f && light.height <= 0.0f
                                              : light.radius <= 0.0f;
}

}  // namespace tetralight
