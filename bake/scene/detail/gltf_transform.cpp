// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_transform.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace tetralight::detail {

glm::dmat4 compose_transform(const glm::dvec3& translation, const glm::dquat& rotation,
                             const glm::dvec3& scale) {
    const double length = std::sqrt(glm::dot(rotation, rotation));
    const glm::dquat unit(rotation.w / length, rotation.x / length, rotation.y / length,
                          rotation.z / length);
    const glm::dmat3 axes = glm::mat3_cast(unit);
    return {glm::dvec4(axes[0] * scale.x, 0.0), glm::dvec4(axes[1] * scale.y, 0.0),
            glm::dvec4(axes[2] * scale.z, 0.0), glm::dvec4(translation, 1.0)};
}

bool is_finite_affine(const glm::dmat4& transform) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            const double value = transform[column][row];
            if (!std::isfinite(value)) return false;
            if (row == 3 && value != (column == 3 ? 1.0 : 0.0)) return false;
        }
    }
    return true;
}

bool is_invertible(const glm::dmat4& transform) {
    constexpr double kRounding = 1e-12;
    const glm::dmat3 axes(transform);
    double largest = 1.0;
    for (int axis = 0; axis < 3; ++axis) largest *= glm::length(axes[axis]);
    return std::abs(glm::determinant(axes)) > kRounding * largest;
}

}  // namespace tetralight::detail
