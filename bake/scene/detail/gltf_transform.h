// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace tetralight::detail {

/// Translation · rotation · scale. The rotation is normalized first; a zero one gives NaN.
[[nodiscard]] glm::dmat4 compose_transform(const glm::dvec3& translation,
                                           const glm::dquat& rotation, const glm::dvec3& scale);

/// True if all sixteen numbers are finite and the last row is (0, 0, 0, 1).
[[nodiscard]] bool is_finite_affine(const glm::dmat4& transform);

/// True if the volume that the transform's axes span is greater than the rounding of the largest
/// volume that axes of their lengths can span.
[[nodiscard]] bool is_invertible(const glm::dmat4& transform);

}  // namespace tetralight::detail
