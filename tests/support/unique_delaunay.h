// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>

#include <tetralight/probes/build/tetrahedralize.h>
#include <tetralight/probes/delaunay/exact_signs.h>

namespace tetralight::test {

/// Exact: whether a Delaunay tetrahedralization is the only one of its positions, because no vertex
/// of a neighbor lies on a tetrahedron's circumsphere.
inline bool is_unique_delaunay(const Tetrahedralization& cells,
                               std::span<const glm::dvec3> positions) {
    for (uint32_t i = 0; i < cells.inner_cell_count; ++i) {
        const auto& v = cells.cells[i].vertices;
        const glm::dvec3 &a = positions[v[0]], &b = positions[v[1]];
        const glm::dvec3 &c = positions[v[2]], &d = positions[v[3]];
        for (const uint32_t neighbor : cells.cells[i].neighbors) {
            if (neighbor >= cells.inner_cell_count) continue;
            const Cell& other = cells.cells[neighbor];
            const auto opposite = std::ranges::find(other.neighbors, i) - other.neighbors.begin();
            const glm::dvec3& e = positions[other.vertices[static_cast<size_t>(opposite)]];
            // Seen with the other orientation, inside is outside: this one is neither.
            const bool is_inside = exact_in_sphere(a, b, c, d, e) > 0;
            if (!is_inside && exact_in_sphere(b, a, c, d, e) <= 0) return false;
        }
    }
    return true;
}

}  // namespace tetralight::test
