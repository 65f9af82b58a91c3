// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace tetralight {

/// The order that visits positions along a Hilbert curve through their bounding cube. Those that
/// share a point of that curve are visited along a curve through their own cube, or by x, y, z when
/// they are few; equal ones by their numbers.
[[nodiscard]] std::vector<uint32_t> hilbert_order(std::span<const glm::dvec3> positions);

}  // namespace tetralight
