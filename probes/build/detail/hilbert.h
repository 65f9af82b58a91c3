// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace tetralight::detail {

/// Index of a lattice point along the Hilbert curve of 2^21 points an axis (Skilling 2004,
/// "Programming the Hilbert curve").
[[nodiscard]] uint64_t hilbert_index(std::array<uint32_t, 3> point) noexcept;

/// The order that visits positions along a Hilbert curve through their bounding cube; equal indices
/// are ordered by x, y, z. Positions near in the order are near in space.
[[nodiscard]] std::vector<uint32_t> hilbert_order(std::span<const glm::dvec3> positions);

}  // namespace tetralight::detail
