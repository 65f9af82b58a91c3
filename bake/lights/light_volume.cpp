// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/light_volume.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace tetralight {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Sphere {
    glm::dvec3 center{0.0};
    double radius = 0.0;
};

/// Largest distance of a point of the light from its position.
double size_of(const Light& light) {
    if (light.type == LightType::Disc) return static_cast<double>(light.radius);
    if (light.type != LightType::Rectangle) return 0.0;
    return 0.5 * std::hypot(static_cast<double>(light.width), static_cast<double>(light.height));
}

double max_distance_of(const Light& light) {
    return static_cast<double>(light.range) + size_of(light);
}

bool is_unbounded(const Light& light) {
    return light.type == LightType::Directional || light.range <= 0.0f;
}

/// The smallest sphere that contains the volume of a light.
Sphere bounding_sphere(const Light& light) {
    const double max_distance = max_distance_of(light);
    const glm::dvec3 apex(light.position);
    const double cosine = static_cast<double>(light.cos_outer_cone);
    if (light.type != LightType::Spot || cosine <= 0.0) return {apex, max_distance};
    const glm::dvec3 axis(light.direction);
    if (cosine * cosine >= 0.5) {  // up to 45°: through the apex and the rim
        const double radius = 0.5 * max_distance / cosine;
        return {apex + radius * axis, radius};
    }
    return {apex + max_distance * cosine * axis, max_distance * std::sqrt(1.0 - cosine * cosine)};
}

/// Signed distance from a position to an infinite cone; negative inside.
double distance_to_cone(const Light& spot, const glm::dvec3& position) {
    const glm::dvec3 offset = position - glm::dvec3(spot.position);
    const double cosine = static_cast<double>(spot.cos_outer_cone);
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double along = glm::dot(offset, glm::dvec3(spot.direction));
    const double across = std::sqrt(std::max(0.0, glm::dot(offset, offset) - along * along));
    const bool is_behind_apex = along * cosine + across * sine < 0.0;
    return is_behind_apex ? glm::length(offset) : across * cosine - along * sine;
}

/// True if a sphere is certainly outside the volume of a light.
bool is_outside(const Light& light, const Sphere& sphere) {
    if (light.type == LightType::Directional) return false;
    const bool is_far =
        light.range > 0.0f && glm::distance(sphere.center, glm::dvec3(light.position)) >
                                  sphere.radius + max_distance_of(light);
    return is_far || (light.type == LightType::Spot &&
                      distance_to_cone(light, sphere.center) > sphere.radius);
}

}  // namespace

bool may_overlap(const Light& a, const Light& b) noexcept {
    if (!is_unbounded(a) && is_outside(b, bounding_sphere(a))) return false;
    if (!is_unbounded(b) && is_outside(a, bounding_sphere(b))) return false;
    if (is_unbounded(a) || is_unbounded(b)) return true;
    const Sphere sphere_a = bounding_sphere(a), sphere_b = bounding_sphere(b);
    return glm::distance(sphere_a.center, sphere_b.center) <= sphere_a.radius + sphere_b.radius;
}

float distance_to_volume(const Light& light, const glm::dvec3& position) noexcept {
    if (light.type == LightType::Directional) return -kInfinity;
    double distance = -static_cast<double>(kInfinity);
    if (light.range > 0.0f) {
        distance = glm::distance(position, glm::dvec3(light.position)) - max_distance_of(light);
    }
    if (light.type == LightType::Spot) {
        distance = std::max(distance, distance_to_cone(light, position));
    }
    return static_cast<float>(distance);
}

}  // namespace tetralight
