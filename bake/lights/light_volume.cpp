// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/light_volume.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace tetralight {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Ball {
    glm::dvec3 center{0.0};
    double radius = 0.0;
};

/// Rectangles and discs shine from all of their surface.
double size_of(const Light& light) {
    if (light.type == LightType::Disc) return static_cast<double>(light.radius);
    if (light.type != LightType::Rectangle) return 0.0;
    return 0.5 * std::hypot(static_cast<double>(light.width), static_cast<double>(light.height));
}

double reach_of(const Light& light) {
    return static_cast<double>(light.range) + size_of(light);
}

bool is_everywhere(const Light& light) {
    return light.type == LightType::Directional || light.range <= 0.0f;
}

/// The smallest ball around a light's volume.
Ball ball_around(const Light& light) {
    const double reach = reach_of(light);
    const glm::dvec3 apex(light.position);
    const double cosine = static_cast<double>(light.cos_outer_cone);
    if (light.type != LightType::Spot || cosine <= 0.0) return {apex, reach};
    const glm::dvec3 axis(light.direction);
    if (cosine * cosine >= 0.5) {  // up to 45°: through the apex and the rim
        const double radius = 0.5 * reach / cosine;
        return {apex + radius * axis, radius};
    }
    return {apex + reach * cosine * axis, reach * std::sqrt(1.0 - cosine * cosine)};
}

/// From a position to an endless cone; inside it minus that to its side.
double distance_to_cone(const Light& spot, const glm::dvec3& position) {
    const glm::dvec3 offset = position - glm::dvec3(spot.position);
    const double cosine = static_cast<double>(spot.cos_outer_cone);
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double along = glm::dot(offset, glm::dvec3(spot.direction));
    const double across = std::sqrt(std::max(0.0, glm::dot(offset, offset) - along * along));
    const bool is_behind_apex = along * cosine + across * sine < 0.0;
    return is_behind_apex ? glm::length(offset) : across * cosine - along * sine;
}

/// Whether a ball surely is outside of a light's volume.
bool is_outside(const Light& light, const Ball& ball) {
    if (light.type == LightType::Directional) return false;
    const bool is_far =
        light.range > 0.0f &&
        glm::distance(ball.center, glm::dvec3(light.position)) > ball.radius + reach_of(light);
    return is_far ||
           (light.type == LightType::Spot && distance_to_cone(light, ball.center) > ball.radius);
}

}  // namespace

bool may_overlap(const Light& a, const Light& b) noexcept {
    if (!is_everywhere(a) && is_outside(b, ball_around(a))) return false;
    if (!is_everywhere(b) && is_outside(a, ball_around(b))) return false;
    if (is_everywhere(a) || is_everywhere(b)) return true;
    const Ball ball_a = ball_around(a), ball_b = ball_around(b);
    return glm::distance(ball_a.center, ball_b.center) <= ball_a.radius + ball_b.radius;
}

float distance_to_volume(const Light& light, const glm::dvec3& position) noexcept {
    if (light.type == LightType::Directional) return -kInfinity;
    double distance = -static_cast<double>(kInfinity);
    if (light.range > 0.0f) {
        distance = glm::distance(position, glm::dvec3(light.position)) - reach_of(light);
    }
    if (light.type == LightType::Spot) {
        distance = std::max(distance, distance_to_cone(light, position));
    }
    return static_cast<float>(distance);
}

}  // namespace tetralight
