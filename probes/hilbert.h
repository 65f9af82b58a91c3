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

/// A cube in which a Hilbert curve orders positions.
struct HilbertCube {
    glm::dvec3 min{0.0};
    /// Lattice points a metre; 0 = all positions are one point.
    double scale = 0.0;

    /// Index of the lattice point below a position; positions outside are clamped to the cube.
    [[nodiscard]] uint64_t index(const glm::dvec3& position) const noexcept;

    bool operator==(const HilbertCube&) const = default;
};

/// The smallest cube that contains the box from `min` to `max` and begins at `min`.
[[nodiscard]] HilbertCube make_hilbert_cube(const glm::dvec3& min, const glm::dvec3& max) noexcept;

}  // namespace tetralight
