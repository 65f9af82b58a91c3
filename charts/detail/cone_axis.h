// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace tetralight::detail {

/// A unit vector whose cosine with each of the normals is at least `min_cosine`, if a few steps
/// from `start` find one. Each step turns towards the normal that is farthest away (Bădoiu &
/// Clarkson 2003, "Smaller Core-Sets for Balls"). Zero vectors among the normals do not count.
[[nodiscard]] std::optional<glm::dvec3> find_cone_axis(std::span<const glm::dvec3> normals,
                                                       glm::dvec3 start, double min_cosine);

}  // namespace tetralight::detail
