// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// Times the squares of three corners, relative to the position: the square of the rounding error
/// of a sum of signed volumes.
inline constexpr double kSliverRounding = 1e-24;

/// Weights of a position in one cell. Not normalized: in a tetrahedron they are signed volumes.
struct CellWeights {
    glm::dvec4 weights{0.0};
    /// Squares of sums up to this may be rounding alone: the cell is a sliver that holds no
    /// position.
    double rounding = 0.0;

    /// In the order of a four-lane sum, so that vector code gives the same bits.
    [[nodiscard]] double sum() const { return (weights.x + weights.z) + (weights.y + weights.w); }

    /// Smallest weight divided by the sum: ≥ 0 inside the cell.
    [[nodiscard]] double inside_measure() const;

    [[nodiscard]] int most_negative() const;
};

/// Signed volumes of the origin with the faces of a tetrahedron: b·(c×d), −a·(c×d), d·(a×b),
/// −c·(a×b).
template <class Real>
[[nodiscard]] glm::vec<4, Real> signed_volumes(
    const std::array<glm::vec<3, Real>, 4>& corners) noexcept {
    const auto& [a, b, c, d] = corners;
    const glm::vec<3, Real> cd = glm::cross(c, d);
    const glm::vec<3, Real> ab = glm::cross(a, b);
    return {glm::dot(b, cd), -glm::dot(a, cd), glm::dot(d, ab), -glm::dot(c, ab)};
}

/// Weights of the origin in a tetrahedron. `corners` are relative to the queried position.
[[nodiscard]] CellWeights tetrahedron_weights(const std::array<glm::dvec3, 4>& corners) noexcept;

/// The same in long double, for cells that are too flat for double.
[[nodiscard]] CellWeights precise_tetrahedron_weights(
    const std::array<glm::dvec3, 4>& corners) noexcept;

/// Weights as queries give them: ≥ 0, sum 1.
[[nodiscard]] CellLocation finish(uint32_t cell, const CellWeights& weights) noexcept;

/// Signed volumes of a far position with the faces of a tetrahedron. Differences from the position
/// would lose the digits in which its corners differ; edges do not. The sum, its volume, is lost.
[[nodiscard]] glm::dvec4 far_signed_volumes(const std::array<glm::dvec3, 4>& corners,
                                            const glm::dvec3& position) noexcept;

/// True if the position is many times the longest edge away from a tetrahedron.
[[nodiscard]] bool is_far(const std::array<glm::dvec3, 4>& corners,
                          const glm::dvec3& position) noexcept;

/// `hull_cell_weights` from differences to the corner nearest to the position: those to a corner
/// that is much farther lose digits.
[[nodiscard]] std::optional<glm::dvec3> weights_from_nearest_corner(
    const std::array<glm::dvec3, 4>& corners, const HullCellRays& rays,
    const glm::dvec3& position) noexcept;

}  // namespace tetralight::detail
