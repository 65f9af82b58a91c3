// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace tetralight {

/// Bits of each axis of a Hilbert curve's lattice.
inline constexpr int kHilbertBits = 21;

/// Index of a lattice point along the Hilbert curve of 2^21 points an axis (Skilling 2004,
/// "Programming the Hilbert curve"). Points near along the curve are near in space.
[[nodiscard]] uint64_t hilbert_index(std::array<uint32_t, 3> point) noexcept;

/// A cube as the lattice of a Hilbert curve.
struct HilbertCube {
    glm::dvec3 low{0.0};
    /// Lattice steps a metre; 0 = everything is one point.
    double scale = 0.0;

    /// Index of the lattice point below a position; positions outside are moved to the cube's side.
    [[nodiscard]] uint64_t index(const glm::dvec3& position) const noexcept;

    bool operator==(const HilbertCube&) const = default;
};

/// The smallest cube that holds the box from `low` to `high`, with the box in its lower corner.
[[nodiscard]] HilbertCube make_hilbert_cube(const glm::dvec3& low, const glm::dvec3& high) noexcept;

}  // namespace tetralight
