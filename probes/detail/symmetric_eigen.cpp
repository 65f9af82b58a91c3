// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/symmetric_eigen.h>

#include <cmath>
#include <glm/matrix.hpp>

namespace tetralight::detail {
namespace {

/// Turns the plane of axes p and q so that their entry becomes 0.
void rotate_away(glm::dmat3& matrix, glm::dmat3& axes, int p, int q) {
    if (matrix[p][q] == 0.0) return;
    const double slope = (matrix[q][q] - matrix[p][p]) / (2.0 * matrix[p][q]);
    // The smaller root, so that angles stay below 45 degrees; 0 where the slope overflows.
    const double tangent = std::copysign(1.0, slope) / (std::abs(slope) + std::hypot(slope, 1.0));
    const double cosine = 1.0 / std::hypot(tangent, 1.0);
    glm::dmat3 rotation(1.0);
    rotation[p][p] = rotation[q][q] = cosine;
    rotation[q][p] = tangent * cosine;
    rotation[p][q] = -tangent * cosine;
    matrix = glm::transpose(rotation) * matrix * rotation;
    matrix[p][q] = matrix[q][p] = 0.0;
    axes = axes * rotation;
}

}  // namespace

SymmetricEigen symmetric_eigen(glm::dmat3 matrix) noexcept {
    constexpr int kSweeps = 10;  // it converges quadratically: the fifth changes nothing
    SymmetricEigen result;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        rotate_away(matrix, result.axes, 0, 1);
        rotate_away(matrix, result.axes, 0, 2);
        rotate_away(matrix, result.axes, 1, 2);
    }
    result.values = {matrix[0][0], matrix[1][1], matrix[2][2]};
    return result;
}

}  // namespace tetralight::detail
