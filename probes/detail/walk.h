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

/// Times the cube of the longest squared edge: the square of the rounding error of a sum of
/// weights.
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
[[nodiscard]] inline glm::dvec4 signed_volumes(const std::array<glm::dvec3, 4>& corners) noexcept {
    const auto& [a, b, c, d] = corners;
    const glm::dvec3 cd = glm::cross(c, d);
    const glm::dvec3 ab = glm::cross(a, b);
    return {glm::dot(b, cd), -glm::dot(a, cd), glm::dot(d, ab), -glm::dot(c, ab)};
}

/// Weights of the origin in a tetrahedron. `corners` are relative to the queried position.
[[nodiscard]] CellWeights tetrahedron_weights(const std::array<glm::dvec3, 4>& corners) noexcept;

/// The same in long double, for cells that are too flat for double.
[[nodiscard]] CellWeights precise_tetrahedron_weights(
    const std::array<glm::dvec3, 4>& corners) noexcept;

/// Weights as queries give them: ≥ 0, sum 1.
[[nodiscard]] CellLocation finish(uint32_t cell, const CellWeights& weights) noexcept;

/// Walks over the cells of one volume towards one position (visibility walk by signs of barycentric
/// weights: Devillers, Pion & Teillaud 2002, "Walking in a Triangulation"). All arithmetic is in
/// double on float positions.
class Walk {
  public:
    /// Precondition: the position is finite.
    Walk(const ProbeVolumeView& volume, const glm::vec3& position) noexcept;

    /// The cell of the seed grid; without a grid, that of the seed that comes next along the
    /// Hilbert curve.
    [[nodiscard]] uint32_t start_cell() const noexcept;

    [[nodiscard]] LocationTrace run(uint32_t start) const noexcept;

  private:
    [[nodiscard]] std::optional<CellWeights> cell_weights(uint32_t cell) const;
    [[nodiscard]] std::optional<CellWeights> precise_weights(uint32_t cell) const;
    [[nodiscard]] CellWeights inner_weights(std::array<glm::dvec3, 4> corners) const;
    [[nodiscard]] CellWeights hull_weights(const std::array<glm::dvec3, 4>& corners,
                                           const HullCellRays& rays) const;
    [[nodiscard]] LocationTrace search_near(uint32_t start) const;
    [[nodiscard]] CellLocation search_all() const;
    [[nodiscard]] CellLocation nearest_corner() const;

    const ProbeVolumeView& volume_;
    glm::dvec3 position_{0.0};
};

}  // namespace tetralight::detail
