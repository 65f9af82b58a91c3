// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/following_cells.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include <tetralight/probes/delaunay/exact_signs.h>
#include "tests/probes/delaunay/point_families.h"

namespace tetralight::detail {
namespace {

using Positions = std::vector<glm::dvec3>;
using Face = std::array<uint32_t, 3>;

/// The vertices of inner cells, and of hull cells in their sense.
struct CellSets {
    std::set<std::array<uint32_t, 4>> inner;
    std::set<Face> hull;

    bool operator==(const CellSets&) const = default;
};

Face turned(Face face) {
    std::rotate(face.begin(), std::ranges::min_element(face), face.end());
    return face;
}

/// Each cell is the neighbor of its neighbors across the face that they share.
void expect_sound(const FollowingCells& following, const std::vector<Cell>& cells,
                  const Positions& p) {
    for (uint32_t i = 0; i < following.count(); ++i) {
        const Cell& cell = cells[i];
        const bool is_inner = i < following.inner_count();
        if (is_inner) {
            const auto& v = cell.vertices;
            ASSERT_EQ(exact_orientation(p[v[0]], p[v[1]], p[v[2]], p[v[3]]), 1);
        } else {
            ASSERT_EQ(cell.vertices[3], kNoIndex);
            ASSERT_LT(cell.neighbors[3], following.inner_count());
        }
        for (size_t corner = 0; corner < 4; ++corner) {
            ASSERT_LT(cell.neighbors[corner], following.count());
            const Cell& other = cells[cell.neighbors[corner]];
            ASSERT_NE(std::ranges::find(other.neighbors, i), other.neighbors.end());
            for (size_t k = 0; k < 4; ++k) {
                if (k == corner || cell.vertices[k] == kNoIndex) continue;
                ASSERT_NE(std::ranges::find(other.vertices, cell.vertices[k]),
                          other.vertices.end());
            }
        }
        if (is_inner) continue;
        // Its face is one of its inner cell, seen from the other side.
        const Cell& inner = cells[cell.neighbors[3]];
        const auto corner =
            static_cast<size_t>(std::ranges::find(inner.neighbors, i) - inner.neighbors.begin());
        Face face;
        for (size_t k = 0; k < 3; ++k) {
            face[k] = inner.vertices[static_cast<size_t>(kOutwardFaces[corner][k])];
        }
        ASSERT_EQ(turned(face), turned({cell.vertices[0], cell.vertices[1], cell.vertices[2]}));
    }
    for (size_t i = following.count(); i < cells.size(); ++i) {
        ASSERT_EQ(cells[i], cells[following.inner_count()]);
    }
}

CellSets sets_of(const FollowingCells& following, const std::vector<Cell>& cells) {
    CellSets sets;
    for (uint32_t i = 0; i < following.count(); ++i) {
        auto v = cells[i].vertices;
        if (i >= following.inner_count()) {
            sets.hull.insert(turned({v[0], v[1], v[2]}));
            continue;
        }
        std::ranges::sort(v);
        sets.inner.insert(v);
    }
    return sets;
}

TEST(FollowingCells, FollowTetrahedraThatChange) {
    for (const char* family : test::kPointFamilies) {
        SCOPED_TRACE(family);
        const Positions points = test::make_points(family, 400, 1);
        std::mt19937 random(2);
        DelaunayTetrahedra tetrahedra;
        tetrahedra.track_changes();
        Positions positions(points.size());
        std::vector<uint32_t> vertices(points.size(), 0);
        FollowingCells following;
        std::vector<Cell> cells;
        std::set<uint32_t> inside;
        for (int step = 0; step < 60; ++step) {
            Positions added;
            std::vector<uint32_t> added_indices, removed;
            const auto share = 1 + random() % 40;
            for (uint32_t i = 0; i < points.size(); ++i) {
                if (random() % share != 0) continue;
                if (inside.erase(i) != 0) {
                    removed.push_back(vertices[i]);
                } else if (step % 3 != 0) {
                    added.push_back(points[i]);
                    added_indices.push_back(i);
                }
            }
            ASSERT_TRUE(tetrahedra.remove(removed));
            std::vector<uint32_t> numbers(added.size());
            ASSERT_TRUE(tetrahedra.insert(added, numbers));
            for (size_t k = 0; k < added.size(); ++k) {
                vertices[added_indices[k]] = numbers[k];
                inside.insert(added_indices[k]);
                positions.resize(std::max<size_t>(positions.size(), numbers[k]));
                positions[numbers[k] - 1] = added[k];
            }
            if (tetrahedra.cells().empty()) continue;
            following.write_changes(tetrahedra, cells);
            tetrahedra.forget_changes();
            expect_sound(following, cells, positions);
            FollowingCells anew;
            std::vector<Cell> all;
            anew.write_all(tetrahedra, all);
            EXPECT_EQ(sets_of(following, cells), sets_of(anew, all));
            if (HasFailure()) return;
        }
    }
}

}  // namespace
}  // namespace tetralight::detail
