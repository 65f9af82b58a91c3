// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tetralight {

/// Samples a rectangle uniformly by the solid angle that it subtends at a position (Ureña, Fajardo
/// & King 2013, "An Area-Preserving Parametrization for Spherical Rectangles"). In double
/// precision, because the solid angle is a difference of angles.
class SphericalRectangle {
  public:
    /// `corner` and the two perpendicular edges at it. Precondition: no edge is zero, and the
    /// position is not in the plane of the rectangle; otherwise the solid angle is 0 or NaN.
    SphericalRectangle(const glm::dvec3& corner, const glm::dvec3& along, const glm::dvec3& across,
                       const glm::dvec3& position) noexcept;

    /// Steradians, 0 to 2π.
    [[nodiscard]] double solid_angle() const { return solid_angle_; }

    /// The point of the rectangle for `u` uniform in [0, 1)².
    [[nodiscard]] glm::vec3 sample(glm::vec2 u) const noexcept;

  private:
    glm::dvec3 position_;
    glm::dmat3 world_from_local_;  // z points away from the rectangle
    glm::dvec2 min_, max_;         // bounds of the rectangle in local x and y
    double z_ = 0.0;               // local z of its plane, negative
    double edge_min_ = 0.0, edge_max_ = 0.0, angle_ = 0.0, solid_angle_ = 0.0;
};

}  // namespace tetralight
