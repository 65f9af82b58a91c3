// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace tetralight::detail {

/// The order that visits positions along a Hilbert curve through their bounding cube; equal indices
/// are ordered by x, y, z.
[[nodiscard]] std::vector<uint32_t> hilbert_order(std::span<const glm::dvec3> positions);

}  // namespace tetralight::detail
