// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/detail/bsp_tree.h>

#include <gtest/gtest.h>
#include <algorithm>
#include <set>

#include <tetralight/engines/detail/boxed_cells.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

using detail::BoxedCells;
using detail::BspNode;
using detail::BspTree;

std::vector<glm::dvec3> lattice(int side) {
    std::vector<glm::dvec3> positions;
    for (int i = 0; i < side * side * side; ++i) {
        positions.emplace_back(i % side, i / side % side, i / (side * side));
    }
    return positions;
}

BspTree tree_of(const BoxedCells& cells) {
    return detail::make_bsp_tree(cells.positions, cells.tetrahedra);
}

BoxedCells cells_of(std::vector<glm::dvec3> positions) {
    return detail::boxed_cells(test::make_lit_volume(std::move(positions)).view());
}

double volume_of(const BoxedCells& cells, const std::array<uint32_t, 4>& v) {
    const auto edge = [&](int i) {
        return glm::dvec3(cells.positions[v[static_cast<size_t>(i)]]) -
               glm::dvec3(cells.positions[v[0]]);
    };
    return glm::dot(edge(1), glm::cross(edge(2), edge(3))) / 6.0;
}

TEST(BspTree, ChildrenComeAfterTheirParentsAndLeavesAreTetrahedra) {
    for (const auto& positions : {test::random_positions(300, 5), lattice(6)}) {
        const BoxedCells cells = cells_of(positions);
        const BspTree tree = tree_of(cells);
        std::set<int32_t> leaves;
        for (int32_t i = 0; i < static_cast<int32_t>(tree.nodes.size()); ++i) {
            const BspNode& node = tree.nodes[static_cast<size_t>(i)];
            EXPECT_NEAR(glm::length(node.normal), 1.0f, 1e-6f);
            for (const int32_t child : {node.over, node.under}) {
                if (child < 0) {
                    leaves.insert(-child - 1);
                } else {
                    EXPECT_GT(child, i);
                }
                EXPECT_LT(child, static_cast<int32_t>(tree.nodes.size()));
            }
        }
        EXPECT_GE(*leaves.begin(), 0);
        EXPECT_LT(*leaves.rbegin(), static_cast<int32_t>(cells.tetrahedra.size()));
    }
}

TEST(BspTree, WalksEndAtTheTetrahedronOfTheirPosition) {
    for (const auto& positions : {test::random_positions(300, 6), lattice(5)}) {
        const BoxedCells cells = cells_of(positions);
        const BspTree tree = tree_of(cells);
        for (uint32_t i = 0; i < cells.tetrahedra.size(); ++i) {
            glm::dvec3 center(0.0);
            double longest = 0.0;
            for (const uint32_t vertex : cells.tetrahedra[i]) {
                center += glm::dvec3(cells.positions[vertex]) / 4.0;
                longest = std::max(longest, glm::distance(center, glm::dvec3(0.0)));
            }
            // Slivers are thinner than the rounding of floats.
            if (volume_of(cells, cells.tetrahedra[i]) < 1e-4 * longest * longest * longest) {
                continue;
            }
            EXPECT_EQ(detail::find_tetrahedron(tree.nodes, glm::vec3(center)), i);
        }
    }
}

/// The depth of a balanced tree is log2 of its leaves.
TEST(BspTree, IsNotDeep) {
    const BoxedCells cells = cells_of(test::random_positions(3000, 7));
    const BspTree tree = tree_of(cells);
    EXPECT_LT(tree.depth, 4.0 * std::log2(cells.tetrahedra.size()));
    EXPECT_LT(tree.nodes.size(), 10 * cells.tetrahedra.size());
}

TEST(BspTree, OfOneTetrahedronHasANode) {
    const std::vector<glm::vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::array<uint32_t, 4> tetrahedron{0, 1, 2, 3};
    const BspTree tree = detail::make_bsp_tree(points, std::span(&tetrahedron, 1));
    ASSERT_EQ(tree.nodes.size(), 1u);
    EXPECT_EQ(detail::find_tetrahedron(tree.nodes, glm::vec3(9.0f)), 0u);
}

/// Tetrahedra fill the box: their volumes are positive, and their sum is that of the box.
TEST(BoxedCells, FillTheBox) {
    const std::vector<glm::dvec3> volumes[] = {
        test::random_positions(200, 8),
        lattice(4),
        {{0, 1, 0}, {1, 1, 0}, {0, 1, 1}, {1, 1, 1}, {0.3, 1, 0.6}},
        {{0, 0, 3}, {1, 0, 3}, {5, 0, 3}},
        {{1, 2, 3}}};
    for (const auto& positions : volumes) {
        const BoxedCells cells = cells_of(positions);
        EXPECT_EQ(cells.positions.size(), positions.size() + 8);
        EXPECT_EQ(cells.light.size(), cells.positions.size());
        double sum = 0.0;
        for (const auto& tetrahedron : cells.tetrahedra) {
            EXPECT_GT(volume_of(cells, tetrahedron), -1e-9);
            sum += volume_of(cells, tetrahedron);
        }
        const glm::dvec3 size(cells.box.size());
        EXPECT_NEAR(sum / (size.x * size.y * size.z), 1.0, 1e-6);
    }
}

TEST(BoxedCells, KeepTheCellsOfTheVolume) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(100, 9));
    const BoxedCells cells = detail::boxed_cells(volume.view());
    for (uint32_t i = 0; i < volume.info.inner_cell_count; ++i) {
        EXPECT_EQ(cells.tetrahedra[i], volume.cells[i].vertices);
    }
}

}  // namespace
}  // namespace tetralight
