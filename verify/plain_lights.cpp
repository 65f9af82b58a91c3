// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/plain_lights.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include <tetralight/bake/scene/surface_color.h>
#include <tetralight/verify/plain_directions.h>

namespace tetralight {
namespace {

/// A light of no size at `point`, with the intensity and the falloff of the light.
Illumination light_from_point(Light light, glm::vec3 point, glm::vec3 position) {
    light.type = LightType::Point;
    light.position = point;
    return illuminate(light, position);
}

PlainLightSample from_sun(const Light& sun, Pcg& random) {
    constexpr float kDistant = std::numeric_limits<float>::infinity();
    if (sun.radius <= 0.0f) return {sun.intensity, -sun.direction, kDistant};
    const float cosine = std::cos(std::min(sun.radius, 0.5f * std::numbers::pi_v<float>));
    // Radiance E / (π sin²) over the solid angle 2π (1 − cos).
    return {sun.intensity * (2.0f / (1.0f + cosine)),
            plain_cone(-sun.direction, cosine, random.next2()), kDistant};
}

PlainLightSample from_sphere(const Light& light, glm::vec3 position, Pcg& random) {
    const Illumination arriving = illuminate(light, position);
    PlainLightSample sample{arriving.irradiance, arriving.to_light, arriving.distance};
    if (light.radius <= 0.0f || arriving.irradiance == glm::vec3(0.0f)) return sample;
    const float sine = std::min(light.radius, arriving.distance) / arriving.distance;
    const float cosine = std::sqrt(std::max(0.0f, 1.0f - sine * sine));
    sample.irradiance *= 2.0f / (1.0f + cosine);
    sample.to_light = plain_cone(arriving.to_light, cosine, random.next2());
    // To the front of the sphere.
    const float along = arriving.distance * glm::dot(sample.to_light, arriving.to_light);
    const float square = sine * sine - 1.0f;
    sample.distance =
        along -
        std::sqrt(std::max(0.0f, along * along + arriving.distance * arriving.distance * square));
    return sample;
}

PlainLightSample from_area(const Light& light, glm::vec3 point, glm::vec3 position) {
    const Illumination arriving = light_from_point(light, point, position);
    const float cosine = std::max(0.0f, -glm::dot(light.direction, arriving.to_light));
    return {arriving.irradiance * cosine, arriving.to_light, arriving.distance};
}

glm::vec3 point_on_area(const Light& light, glm::vec2 u) {
    if (light.type == LightType::Rectangle) {
        const glm::vec3 across = glm::cross(light.direction, light.tangent);
        return light.position + (u.x - 0.5f) * light.width * light.tangent +
               (u.y - 0.5f) * light.height * across;
    }
    const float angle = 2.0f * std::numbers::pi_v<float> * u.y;
    const PlainFrame frame(light.direction);
    return light.position +
           light.radius * std::sqrt(u.x) * (std::cos(angle) * frame.x + std::sin(angle) * frame.y);
}

}  // namespace

PlainLightSample sample_plain_light(const Light& light, glm::vec3 position, Pcg& random) {
    switch (light.type) {
        case LightType::Directional:
            return from_sun(light, random);
        case LightType::Point:
        case LightType::Spot:
            return from_sphere(light, position, random);
        case LightType::Rectangle:
        case LightType::Disc:
            break;
    }
    return from_area(light, point_on_area(light, random.next2()), position);
}

PlainLightSample PlainLights::sample(uint32_t i, glm::vec3 position, Pcg& random) const {
    const auto count = static_cast<double>(lights_.size());
    const auto draws = static_cast<double>(draw_count());
    if (lights_.size() <= 4) return sample_plain_light(lights_[i], position, random);
    const double place = (i + double{random.next()}) / draws * count;
    const size_t chosen = std::min(lights_.size() - 1, static_cast<size_t>(place));
    PlainLightSample sample = sample_plain_light(lights_[chosen], position, random);
    sample.irradiance *= static_cast<float>(count / draws);
    return sample;
}

PlainEmitters::PlainEmitters(const Scene& scene, const TraceScene& traced)
    : density_(traced.geometry_count(), 0.0f) {
    double sum = 0.0;
    for (uint32_t geometry = 0; geometry < traced.geometry_count(); ++geometry) {
        if (!traced.can_emit(geometry)) continue;
        const glm::vec3 factor = emission_source(scene.materials[traced.material(geometry)]).factor;
        const float weight = std::max({factor.x, factor.y, factor.z});
        if (!(weight > 0.0f)) continue;
        density_[geometry] = weight;
        for (uint32_t primitive = 0; primitive < traced.triangle_count(geometry); ++primitive) {
            const Triangle triangle{traced.triangle(geometry, primitive), geometry, primitive};
            const auto& [a, b, c] = triangle.corners;
            sum += 0.5 * double{weight} * double{glm::length(glm::cross(b - a, c - a))};
            triangles_.push_back(triangle);
            sums_.push_back(sum);
        }
    }
    for (float& density : density_) density = sum > 0.0 ? static_cast<float>(density / sum) : 0.0f;
    if (!(sum > 0.0)) triangles_.clear();
}

PlainEmitters::Choice PlainEmitters::sample(glm::vec3 position, Pcg& random) const {
    const double fine = random.next() + double{random.next()} * 0x1p-24;
    const auto found = std::ranges::upper_bound(sums_, fine * sums_.back());
    const auto index =
        std::min<size_t>(triangles_.size() - 1, static_cast<size_t>(found - sums_.begin()));
    const Triangle& triangle = triangles_[index];
    const auto& [a, b, c] = triangle.corners;
    const glm::vec2 u = random.next2();
    const float root = std::sqrt(u.x);
    const glm::vec3 point = a + (1.0f - root) * (b - a) + u.y * root * (c - a);
    const glm::vec3 offset = point - position;
    const float distance = glm::length(offset);
    if (!(distance > 0.0f)) return {};
    const glm::vec3 normal = glm::cross(b - a, c - a);
    const float area2 = glm::length(normal);
    const float least_weight = std::min({1.0f - root, u.y * root, (1.0f - u.y) * root});
    const float longest = std::max({glm::length(b - a), glm::length(c - a), glm::length(c - b)});
    return {.direction = offset / distance,
            .point = point,
            .edge_distance = least_weight * area2 / longest,
            .normal = normal / area2,
            .geometry = triangle.geometry,
            .primitive = triangle.primitive};
}

bool PlainEmitters::is_chosen(const Choice& choice, glm::vec3 origin, const Surface& surface) {
    if (surface.geometry != choice.geometry) return false;
    if (surface.primitive == choice.primitive) return true;
    const glm::vec3 front =
        surface.is_from_behind ? -surface.geometric_normal : surface.geometric_normal;
    if (!(glm::dot(front, choice.normal) > 0.0f)) return false;
    // The error of a ray's ends, as `TraceScene` bounds it, and of its direction; once for the
    // point and once for the hit. It grows along surfaces that the ray grazes.
    float extent = 0.0f;
    for (int axis = 0; axis < 3; ++axis)
        extent = std::max({extent, std::abs(origin[axis]), std::abs(choice.point[axis])});
    const float rounding = 2.0f * std::max(surface.error_bound, extent * 0x1p-21f);
    const float cosine = std::min(std::abs(glm::dot(front, choice.direction)),
                                  std::abs(glm::dot(choice.normal, choice.direction)));
    const float tolerance = rounding / std::max(cosine, 1e-3f);
    return choice.edge_distance <= tolerance &&
           std::abs(glm::dot(surface.position - choice.point, choice.direction)) <= tolerance;
}

float PlainEmitters::pdf(glm::vec3 origin, glm::vec3 direction, const Surface& surface) const {
    const float density = density_[surface.geometry];
    if (!(density > 0.0f)) return 0.0f;
    const glm::vec3 offset = surface.position - origin;
    const float cosine = std::abs(glm::dot(surface.geometric_normal, direction));
    return density * glm::dot(offset, offset) / std::max(cosine, 1e-7f);
}

}  // namespace tetralight
