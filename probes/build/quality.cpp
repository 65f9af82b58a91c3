// SPDX-License-Identifier: Apache-2.0
#include "probes/build/quality.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <numbers>

namespace tetralight {

double tetrahedron_quality(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                           const glm::dvec3& d) {
    double squares = 0.0;
    for (const glm::dvec3& edge : {b - a, c - a, d - a, c - b, d - b, d - c}) {
        squares += glm::dot(edge, edge);
    }
    const double rms_edge = std::sqrt(squares / 6.0);
    if (rms_edge == 0.0) return 0.0;
    const double six_volumes = glm::dot(b - a, glm::cross(c - a, d - a));
    return std::numbers::sqrt2 * six_volumes / (rms_edge * rms_edge * rms_edge);
}

}  // namespace tetralight
