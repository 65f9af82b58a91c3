// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

// Signs of determinants of positions, exact for all finite doubles: positions are whole multiples
// of the lowest bit that one of them has, and the determinants are computed with integers.

namespace tetralight {

/// The exponents between which all bits of coordinates lie: they are whole multiples of 2^lowest,
/// and smaller than 2^highest.
struct ExponentRange {
    int lowest = 5000;
    int highest = -5000;

    void include(double coordinate);
};

/// The sign of dot(b − a, cross(c − a, d − a)): 1 for a positively oriented tetrahedron, 0 if all
/// lie in one plane.
[[nodiscard]] int exact_orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                    const glm::dvec3& d);

/// 1 if e lies in the circumsphere of a positively oriented tetrahedron, −1 if it lies outside, 0
/// if it lies on it. The sign of the determinant of the rows (p − e, |p − e|²).
[[nodiscard]] int exact_in_sphere(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                  const glm::dvec3& d, const glm::dvec3& e);

/// The same of coordinates whose differences are whole numbers of at most 24 bits times 1 /
/// per_unit: several times as fast.
[[nodiscard]] int small_orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                    const glm::dvec3& d, double per_unit);
[[nodiscard]] int small_in_sphere(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                  const glm::dvec3& d, const glm::dvec3& e, double per_unit);

/// The sign of cross(b − a, c − a): 1 for a counter-clockwise triangle, 0 if all lie on one line.
[[nodiscard]] int exact_orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);

/// 1 if d lies in the circumcircle of a counter-clockwise triangle, −1 outside, 0 on it.
[[nodiscard]] int exact_in_circle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                                  const glm::dvec2& d);

}  // namespace tetralight
