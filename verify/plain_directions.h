// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

// Directions of the referee, from two uniform numbers.

namespace tetralight {

/// Unit vectors at right angles to each other and to a unit vector.
struct PlainFrame {
    glm::vec3 x, y, z;

    explicit PlainFrame(glm::vec3 axis) : z(axis) {
        const glm::vec3 other = std::abs(axis.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        x = glm::normalize(glm::cross(other, axis));
        y = glm::cross(axis, x);
    }

    /// The direction with this cosine to the axis, at a fraction of a turn around it.
    [[nodiscard]] glm::vec3 direction(float cosine, float turn) const {
        const float sine = std::sqrt(std::fmax(0.0f, 1.0f - cosine * cosine));
        const float angle = 2.0f * std::numbers::pi_v<float> * turn;
        return glm::normalize(sine * std::cos(angle) * x + sine * std::sin(angle) * y + cosine * z);
    }
};

/// Even over the sphere.
[[nodiscard]] inline glm::vec3 plain_sphere(glm::vec2 u) {
    return PlainFrame({0, 0, 1}).direction(1.0f - 2.0f * u.x, u.y);
}

/// Even over the cone around an axis whose half angle has this cosine.
[[nodiscard]] inline glm::vec3 plain_cone(glm::vec3 axis, float cosine, glm::vec2 u) {
    return PlainFrame(axis).direction(1.0f - u.x * (1.0f - cosine), u.y);
}

/// With density cosine / π over a hemisphere.
[[nodiscard]] inline glm::vec3 plain_hemisphere(glm::vec3 normal, glm::vec2 u) {
    return PlainFrame(normal).direction(std::sqrt(1.0f - u.x), u.y);
}

}  // namespace tetralight
