// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Delaunay cells and hull cells over a set of positions, in canonical order: inner cells by their
/// sorted vertices, then hull cells. Structure as documented at `Cell`.
struct Tetrahedralization {
    std::vector<Cell> cells;
    uint32_t inner_cell_count = 0;
    Dimension dimension = Dimension::None;
    /// As `VolumeInfo::axis`.
    glm::dvec3 axis{0.0};

    bool operator==(const Tetrahedralization&) const = default;
};

/// Tetrahedralizes positions with exact predicates (`DelaunayTetrahedra`): every position becomes a
/// vertex.
///
/// Any number of positions anywhere is fine. Those that deviate from one plane (line, point) by at
/// most `flatness` metres become triangles in that plane (segments along the line, one cell).
/// Precondition: finite, farther from each other than twice the flatness (see `merge`).
[[nodiscard]] Tetrahedralization tetrahedralize(std::span<const glm::dvec3> positions,
                                                double flatness = 0.0);

}  // namespace tetralight
