// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/affine_dimension.h>

#include <glm/geometric.hpp>

namespace tetralight {

int affine_dimension(std::span<const glm::dvec3> positions) {
    constexpr double kFlat = 1e-6;
    if (positions.empty()) return -1;
    glm::dvec3 axes[3];
    double extent = 0.0;
    for (int dimension = 0; dimension < 3; ++dimension) {
        // The position farthest from the span of the previous axes gives the next, orthogonal axis.
        double farthest = 0.0;
        for (const glm::dvec3& position : positions) {
            glm::dvec3 rest = position - positions[0];
            for (int i = 0; i < dimension; ++i) rest -= glm::dot(rest, axes[i]) * axes[i];
            const double distance = glm::length(rest);
            if (distance <= farthest) continue;
            farthest = distance;
            axes[dimension] = rest / distance;
        }
        if (dimension == 0) extent = farthest;
        if (!(farthest > kFlat * extent)) return dimension;
    }
    return 3;
}

}  // namespace tetralight
