// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/result.h"
#include "probes/probe_volume.h"

namespace tetralight {

/// Delaunay tetrahedra and hull cells over a set of positions, in canonical order: tetrahedra by
/// their sorted vertices, then hull cells. Structure as documented at `Cell`.
struct Tetrahedralization {
    std::vector<Cell> cells;
    uint32_t tetrahedron_count = 0;

    bool operator==(const Tetrahedralization&) const = default;
};

/// Tetrahedralizes distinct positions with exact predicates (CGAL): every position becomes a
/// vertex. None: no cells. Errors: positions that all lie in one plane. Precondition: finite,
/// distinct (see `merge`).
[[nodiscard]] Result<Tetrahedralization> tetrahedralize(std::span<const glm::dvec3> positions);

}  // namespace tetralight
