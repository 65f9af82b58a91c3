// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace tetralight::detail {

/// matrix = axes · diag(values) · axesᵀ; the axes are the columns, orthonormal, in no order.
struct SymmetricEigen {
    glm::dvec3 values{0.0};
    glm::dmat3 axes{1.0};
};

/// By Jacobi's rotations: exact up to rounding for every symmetric matrix, equal eigenvalues too.
[[nodiscard]] SymmetricEigen symmetric_eigen(glm::dmat3 matrix) noexcept;

}  // namespace tetralight::detail
