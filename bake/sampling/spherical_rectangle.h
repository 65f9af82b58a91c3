// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tetralight {

/// A rectangle as a position sees it, to be sampled uniformly by solid angle (Ureña, Fajardo & King
/// 2013, "An Area-Preserving Parametrization for Spherical Rectangles"). In double: the solid angle
/// is a difference of angles.
class SphericalRectangle {
  public:
    /// Corner and the two edges that leave it at right angles. Precondition: no edge is zero, and
    /// the position is not in the rectangle's plane, else the solid angle is 0 or not a number.
    SphericalRectangle(const glm::dvec3& corner, const glm::dvec3& along, const glm::dvec3& across,
                       const glm::dvec3& position) noexcept;

    /// Steradians, 0 to 2π.
    [[nodiscard]] double solid_angle() const { return solid_angle_; }

    /// The point of the rectangle for `u` uniform in [0, 1)².
    [[nodiscard]] glm::vec3 sample(glm::vec2 u) const noexcept;

  private:
    glm::dvec3 position_;
    glm::dmat3 world_from_local_;  // z away from the rectangle's front or back
    glm::dvec2 low_, high_;        // the rectangle in local x and y
    double z_ = 0.0;               // its plane; below 0
    double edge_low_ = 0.0, edge_high_ = 0.0, angle_ = 0.0, solid_angle_ = 0.0;
};

}  // namespace tetralight
