// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include <tetralight/probes/detail/cell_weights.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

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

    /// Walks from `start`; if that fails, walks from `start_cell()` at random, then directly; if
    /// all fail, searches all cells.
    [[nodiscard]] LocationTrace run(uint32_t start) const noexcept;

  private:
    /// No cell if the walk ends at cells that do not contain the position.
    [[nodiscard]] LocationTrace walk_from(uint32_t start, size_t cells_near) const;
    /// No cell if it takes too many steps.
    [[nodiscard]] LocationTrace wander_from(uint32_t start) const;
    [[nodiscard]] std::optional<CellWeights> cell_weights(uint32_t cell) const;
    [[nodiscard]] std::optional<CellWeights> precise_weights(uint32_t cell) const;
    [[nodiscard]] CellWeights inner_weights(std::array<glm::dvec3, 4> corners) const;
    [[nodiscard]] CellWeights hull_weights(const std::array<glm::dvec3, 4>& corners,
                                           const HullCellRays& rays) const;
    [[nodiscard]] LocationTrace search_near(uint32_t start, size_t count) const;
    [[nodiscard]] CellLocation search_all() const;
    [[nodiscard]] CellLocation nearest_corner() const;

    const ProbeVolumeView& volume_;
    glm::dvec3 position_{0.0};
};

}  // namespace tetralight::detail
