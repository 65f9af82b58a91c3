// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// Delaunay tetrahedra over distinct positions, positively oriented, in canonical order; kNoIndex
/// neighbors are outside the hull. Empty when all positions lie in one plane. Positions on one
/// sphere have one answer too, by a perturbation that depends on them alone (Devillers & Teillaud
/// 2003). Fast where positions that follow each other are near each other.
[[nodiscard]] std::vector<Cell> delaunay_tetrahedra(std::span<const glm::dvec3> positions);

/// The same for a set of positions that changes: what is kept from one set to the next saves most
/// of the time where they differ little.
class DelaunayTetrahedra {
  public:
    DelaunayTetrahedra();
    ~DelaunayTetrahedra();
    DelaunayTetrahedra(DelaunayTetrahedra&&) noexcept;
    DelaunayTetrahedra& operator=(DelaunayTetrahedra&&) noexcept;

    /// `delaunay_tetrahedra` of these positions. The result does not depend on the set before.
    [[nodiscard]] std::vector<Cell> change_to(std::span<const glm::dvec3> positions);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace tetralight::detail
