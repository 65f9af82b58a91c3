// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/tetrahedralize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

double volume_of(const Cell& cell, std::span<const glm::dvec3> p) {
    const auto& v = cell.vertices;
    return glm::dot(p[v[1]] - p[v[0]], glm::cross(p[v[2]] - p[v[0]], p[v[3]] - p[v[0]])) / 6.0;
}

std::vector<glm::dvec3> cube_lattice(int n) {
    std::vector<glm::dvec3> positions;
    for (int i = 0; i < n * n * n; ++i) positions.emplace_back(i % n, i / n % n, i / (n * n));
    return positions;
}

TEST(Tetrahedralize, FourPositionsAreOneTetrahedronAndFourHullCells) {
    const std::vector<glm::dvec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto result = tetrahedralize(p);
    ASSERT_EQ(result.inner_cell_count, 1u);
    ASSERT_EQ(result.cells.size(), 5u);
    EXPECT_DOUBLE_EQ(volume_of(result.cells[0], p), 1.0 / 6.0);
}

TEST(Tetrahedralize, FillsACubeExactly) {
    const auto p = cube_lattice(5);
    const auto result = tetrahedralize(p);
    double sum = 0.0;
    for (uint32_t i = 0; i < result.inner_cell_count; ++i) {
        EXPECT_GT(volume_of(result.cells[i], p), 0.0);
        sum += volume_of(result.cells[i], p);
    }
    EXPECT_NEAR(sum, 64.0, 1e-12);
    // The hull of a 4×4×4 cube: 6 sides of 16 squares, each 2 triangles.
    EXPECT_EQ(result.cells.size() - result.inner_cell_count, 192u);
}

TEST(Tetrahedralize, HullTrianglesFaceOutwards) {
    const auto p = test::random_positions(100, 1);
    const auto result = tetrahedralize(p);
    for (size_t i = result.inner_cell_count; i < result.cells.size(); ++i) {
        const auto& v = result.cells[i].vertices;
        const glm::dvec3 normal = glm::cross(p[v[1]] - p[v[0]], p[v[2]] - p[v[0]]);
        for (const glm::dvec3& other : p) {
            EXPECT_LE(glm::dot(normal, other - p[v[0]]), 1e-12);
        }
    }
}

TEST(Tetrahedralize, DoesNotDependOnTheOrderOfPositionsButForTheirNumbers) {
    for (const auto& p : {test::random_positions(200, 2), cube_lattice(6)}) {
        std::vector<glm::dvec3> reversed(p.rbegin(), p.rend());
        const auto a = tetrahedralize(p);
        const auto b = tetrahedralize(reversed);
        ASSERT_EQ(a.cells.size(), b.cells.size());
        const auto sorted_corners = [&](const Tetrahedralization& t, bool is_reversed) {
            std::vector<std::array<uint32_t, 4>> all;
            for (uint32_t i = 0; i < t.inner_cell_count; ++i) {
                auto v = t.cells[i].vertices;
                for (uint32_t& vertex : v) {
                    if (is_reversed) vertex = static_cast<uint32_t>(p.size()) - 1 - vertex;
                }
                std::ranges::sort(v);
                all.push_back(v);
            }
            std::ranges::sort(all);
            return all;
        };
        EXPECT_EQ(sorted_corners(a, false), sorted_corners(b, true));
    }
}

TEST(Tetrahedralize, CellsStandInCanonicalOrder) {
    const auto result = tetrahedralize(test::random_positions(150, 3));
    const auto begin = result.cells.begin();
    const auto hull = begin + result.inner_cell_count;
    const auto by_vertices = [](const Cell& a, const Cell& b) { return a.vertices < b.vertices; };
    EXPECT_TRUE(std::is_sorted(begin, hull, by_vertices));
    EXPECT_TRUE(std::is_sorted(hull, result.cells.end(), by_vertices));
}

TEST(Tetrahedralize, NothingHasNoCells) {
    const auto result = tetrahedralize({});
    EXPECT_TRUE(result.cells.empty());
}

}  // namespace
}  // namespace tetralight
