// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/sampling/spherical_rectangle.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace tetralight {
namespace {

/// Interior angle between two planes that share an edge, from their outward normals.
double inner_angle(const glm::dvec3& a, const glm::dvec3& b) {
    return std::acos(std::clamp(-glm::dot(a, b), -1.0, 1.0));
}

}  // namespace

SphericalRectangle::SphericalRectangle(const glm::dvec3& corner, const glm::dvec3& along,
                                       const glm::dvec3& across,
                                       const glm::dvec3& position) noexcept
    : position_(position) {
    const double width = glm::length(along), height = glm::length(across);
    const glm::dvec3 x = along / width, y = across / height, offset = corner - position;
    glm::dvec3 z = glm::cross(x, y);
    if (glm::dot(offset, z) > 0.0) z = -z;
    world_from_local_ = glm::dmat3(x, y, z);
    min_ = {glm::dot(offset, x), glm::dot(offset, y)};
    max_ = min_ + glm::dvec2(width, height);
    z_ = glm::dot(offset, z);

    const glm::dvec3 v00(min_.x, min_.y, z_), v01(min_.x, max_.y, z_);
    const glm::dvec3 v10(max_.x, min_.y, z_), v11(max_.x, max_.y, z_);
    const glm::dvec3 n0 = glm::normalize(glm::cross(v00, v10));
    const glm::dvec3 n1 = glm::normalize(glm::cross(v10, v11));
    const glm::dvec3 n2 = glm::normalize(glm::cross(v11, v01));
    const glm::dvec3 n3 = glm::normalize(glm::cross(v01, v00));
    edge_min_ = n0.z;
    edge_max_ = n2.z;
    angle_ = 2.0 * std::numbers::pi - inner_angle(n2, n3) - inner_angle(n3, n0);
    solid_angle_ = inner_angle(n0, n1) + inner_angle(n1, n2) - angle_;
}

glm::vec3 SphericalRectangle::sample(glm::vec2 u) const noexcept {
    const double a = u.x * solid_angle_ + angle_;
    const double f = (std::cos(a) * edge_min_ - edge_max_) / std::sin(a);
    const double c = std::clamp(std::copysign(1.0 / std::hypot(f, edge_min_), f), -1.0, 1.0);
    // At c = ±1 the quotient is infinite, and the clamp gives the edge of the rectangle.
    const double x = std::clamp(-c * z_ / std::sqrt(1.0 - c * c), min_.x, max_.x);
    const double d = std::hypot(x, z_);
    const double h_min = min_.y / std::hypot(d, min_.y);
    const double h_max = max_.y / std::hypot(d, max_.y);
    const double h = h_min + u.y * (h_max - h_min);
    const double y = std::clamp(h * d / std::sqrt(1.0 - h * h), min_.y, max_.y);
    return glm::vec3(position_ + world_from_local_ * glm::dvec3(x, y, z_));
}

}  // namespace tetralight
