// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/probes/delaunay/delaunay_tetrahedra.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// Delaunay tetrahedra over distinct positions, positively oriented, in canonical order; kNoIndex
/// neighbors are outside the hull. Empty when all positions lie in one plane. Positions on one
/// sphere have one answer too (DelaunayTetrahedra). Fast where positions that follow each other are
/// near each other.
[[nodiscard]] std::vector<Cell> delaunay_tetrahedra(std::span<const glm::dvec3> positions);

/// Delaunay triangles over distinct positions in a plane, counter-clockwise, with three vertices,
/// in no particular order. Empty when all positions lie on one line.
[[nodiscard]] std::vector<Cell> delaunay_triangles(std::span<const glm::dvec2> positions);

/// `delaunay_tetrahedra` of a set of positions that changes: what is kept from one set to the next
/// saves most of the time where they differ little.
class KeptTetrahedra {
  public:
    /// `delaunay_tetrahedra` of these positions. The result does not depend on the set before.
    /// Returns out_of_resources if memory is short; the next set is made anew then.
    [[nodiscard]] Result<std::vector<Cell>> change_to(std::span<const glm::dvec3> positions);

  private:
    [[nodiscard]] Status make_anew(std::span<const glm::dvec3> positions);
    [[nodiscard]] Status change(std::span<const glm::dvec3> positions);

    DelaunayTetrahedra tetrahedra_;
    std::vector<glm::dvec3> positions_;
    std::vector<uint32_t> vertices_;  // one a position
};

}  // namespace tetralight::detail
