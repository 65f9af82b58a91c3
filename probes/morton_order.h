// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace tetralight {

/// Sorts positions along a Morton curve through their bounding box, whose resolution grows with
/// their number. Element i of the result holds the index of the i-th position in its low 32 bits;
/// it is part of `memory`, of which two elements a position are used. Positions that are not finite
/// come first. Radix sort: the time is proportional to the number of positions.
[[nodiscard]] std::span<const uint64_t> morton_order(std::span<const glm::vec3> positions,
                                                     std::span<uint64_t> memory) noexcept;

}  // namespace tetralight
