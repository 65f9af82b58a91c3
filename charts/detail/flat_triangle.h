// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tetralight::detail {

/// Corners of a triangle in a plane.
using FlatTriangle = std::array<glm::dvec2, 3>;

/// Twice the signed area of abc: positive if counterclockwise. Exactly 0 if p is a or b.
[[nodiscard]] inline double twice_signed_area(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) noexcept {
    const glm::dvec2 ab = b - a;
    const glm::dvec2 ap = p - a;
    return ab.x * ap.y - ab.y * ap.x;
}

/// Two axes that are counterclockwise seen from the side to which a direction points.
struct PlaneFrame {
    glm::dvec3 u{};
    glm::dvec3 v{};

    [[nodiscard]] glm::dvec2 project(glm::dvec3 point) const noexcept {
        return {glm::dot(u, point), glm::dot(v, point)};
    }
};

/// A frame perpendicular to a unit vector (Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited").
[[nodiscard]] inline PlaneFrame make_plane_frame(glm::dvec3 n) noexcept {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;
    return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

/// True if two triangles, both counterclockwise, have an area in common. Overlaps that are thinner
/// than a millionth of an edge do not count: that much positions differ where a corner of one
/// triangle lies in an edge of another.
[[nodiscard]] bool overlap(const FlatTriangle& a, const FlatTriangle& b) noexcept;

}  // namespace tetralight::detail
