// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/probes/build/tetrahedralize.h>

namespace tetralight {

/// `canonical_cells` of tetrahedra from another program, if they are a Delaunay tetrahedralization
/// of the positions. Their indices are not trusted; kNoIndex neighbors are outside the hull.
///
/// Returns corrupt if an index is out of range, tetrahedra are not each other's neighbors,
/// positions are missing, or `validate` finds an error by exact arithmetic: inverted tetrahedra,
/// faces that break the Delaunay property, a hull that is not convex, or not in one piece.
[[nodiscard]] Result<Tetrahedralization> check_tetrahedra(std::vector<Cell> tetrahedra,
                                                          std::span<const glm::dvec3> positions);

}  // namespace tetralight
