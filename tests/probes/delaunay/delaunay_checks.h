// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include <tetralight/probes/delaunay/delaunay_tetrahedra.h>
#include <tetralight/probes/delaunay/exact_signs.h>

namespace tetralight::test {

using Corner = std::array<double, 3>;
using Corners = std::array<Corner, 4>;

/// The tetrahedra by the positions of their corners, whatever the numbers of vertices are.
inline std::set<Corners> tetrahedra(const DelaunayTetrahedra& delaunay) {
    std::set<Corners> result;
    for (const DelaunayCell& cell : delaunay.cells()) {
        if (!cell.is_finite()) continue;
        Corners corners;
        for (size_t i = 0; i < 4; ++i) {
            const glm::dvec3& p = delaunay.position(cell.vertices[i]);
            corners[i] = {p.x, p.y, p.z};
        }
        std::ranges::sort(corners);
        result.insert(corners);
    }
    return result;
}

inline DelaunayTetrahedra delaunay_of(const std::vector<glm::dvec3>& points) {
    DelaunayTetrahedra delaunay;
    std::vector<uint32_t> vertices(points.size());
    EXPECT_TRUE(delaunay.insert(points, vertices));
    return delaunay;
}

/// Each cell is the neighbor of its neighbors, across the triangle that they share, and turned as
/// it should be; the ghosts close the hull: a sphere of 4 ghosts and their finite neighbors.
inline void expect_sound(const DelaunayTetrahedra& delaunay) {
    const auto cells = delaunay.cells();
    for (uint32_t i = 0; i < cells.size(); ++i) {
        if (cells[i].is_free()) continue;
        const auto& [a, b, c, d] = cells[i].vertices;
        for (uint32_t corner = 0; corner < 4; ++corner) {
            const uint32_t neighbor = cells[i].neighbors[corner];
            ASSERT_LT(neighbor / 4, cells.size());
            const DelaunayCell& other = cells[neighbor / 4];
            ASSERT_FALSE(other.is_free());
            ASSERT_EQ(other.neighbors[neighbor % 4], 4 * i + corner);
            for (uint32_t k = 0; k < 4; ++k) {
                const bool is_shared =
                    std::ranges::find(other.vertices, cells[i].vertices[k]) != other.vertices.end();
                ASSERT_EQ(is_shared, k != corner);
            }
        }
        if (!cells[i].is_finite()) continue;
        ASSERT_EQ(exact_orientation(delaunay.position(a), delaunay.position(b),
                                    delaunay.position(c), delaunay.position(d)),
                  1);
    }
}

/// No position is inside of the circumsphere of a tetrahedron: by the definition, for all pairs.
inline void expect_delaunay(const DelaunayTetrahedra& delaunay,
                            const std::vector<glm::dvec3>& points) {
    for (const DelaunayCell& cell : delaunay.cells()) {
        if (!cell.is_finite()) continue;
        const auto& [a, b, c, d] = cell.vertices;
        for (const glm::dvec3& point : points) {
            ASSERT_LE(exact_in_sphere(delaunay.position(a), delaunay.position(b),
                                      delaunay.position(c), delaunay.position(d), point),
                      0);
        }
    }
}

/// The same by the neighbors of each tetrahedron alone, which is enough where cells are sound and
/// the hull is convex.
inline void expect_locally_delaunay(const DelaunayTetrahedra& delaunay) {
    const auto cells = delaunay.cells();
    const auto position = [&](uint32_t vertex) { return delaunay.position(vertex); };
    for (const DelaunayCell& cell : cells) {
        if (cell.is_free()) continue;
        const auto& [a, b, c, d] = cell.vertices;
        for (uint32_t corner = 0; corner < 4; ++corner) {
            const uint32_t neighbor = cell.neighbors[corner];
            const uint32_t beyond = cells[neighbor / 4].vertices[neighbor % 4];
            if (beyond == DelaunayCell::kGhost) continue;
            if (cell.is_finite()) {
                ASSERT_LE(exact_in_sphere(position(a), position(b), position(c), position(d),
                                          position(beyond)),
                          0);
            } else if (corner != 3) {
                // The triangle is counter-clockwise seen from outside: nothing lies beyond it.
                ASSERT_LE(
                    exact_orientation(position(a), position(b), position(c), position(beyond)), 0);
            }
        }
    }
}

}  // namespace tetralight::test
