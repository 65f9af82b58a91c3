// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/position_tree.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <tetralight/probes/build/hilbert_order.h>
#include "tests/support/random_probes.h"

namespace tetralight::detail {
namespace {

std::vector<glm::dvec3> along_curve(const std::vector<glm::dvec3>& positions) {
    std::vector<glm::dvec3> sorted;
    for (const uint32_t i : hilbert_order(positions)) sorted.push_back(positions[i]);
    return sorted;
}

/// By comparing with all others: to the seventh, or to the one in the middle of few.
double spacing_at(const std::vector<glm::dvec3>& positions, size_t i) {
    std::vector<double> distances;
    for (const glm::dvec3& p : positions) distances.push_back(glm::distance(p, positions[i]));
    std::ranges::sort(distances);  // the first is the position's own
    return distances[positions.size() >= 8 ? 7 : std::max<size_t>(1, positions.size() / 2)];
}

TEST(PositionTree, BoxesHoldTheirPositionsAndLeavesAreSmall) {
    const auto positions = along_curve(test::random_positions(1000, 1));
    const PositionTree tree(positions);
    uint32_t in_leaves = 0;
    for (const auto& node : tree.nodes()) {
        for (uint32_t i = node.begin; i < node.end; ++i) {
            EXPECT_EQ(glm::clamp(positions[i], node.bounds.min, node.bounds.max), positions[i]);
        }
        if (!node.is_leaf()) continue;
        in_leaves += node.size();
        EXPECT_GE(node.size(), PositionTree::kLeafSize);
        EXPECT_LT(node.size(), 2 * PositionTree::kLeafSize);
    }
    EXPECT_EQ(in_leaves, 1000u);
}

TEST(PositionTree, SpacingIsTheDistanceToTheSeventhNeighborOrTheMiddleOne) {
    for (const size_t count : {2u, 3u, 4u, 5u, 7u, 8u, 9u, 17u, 500u}) {
        const auto positions = along_curve(test::random_positions(count, count));
        const PositionTree tree(positions);
        for (uint32_t i = 0; i < count; ++i) {
            ASSERT_EQ(tree.spacing(i), spacing_at(positions, i)) << count << " " << i;
        }
    }
}

TEST(PositionTree, OnePositionHasNoSpacing) {
    const std::vector<glm::dvec3> one{{1, 2, 3}};
    EXPECT_EQ(PositionTree(one).spacing(0), 0.0);
}

TEST(PositionTree, MeasuresGapsAndDiagonalsOfBoxes) {
    const PositionTree::Node a{{{0, 0, 0}, {1, 1, 1}}}, b{{{4, 5, 0}, {5, 6, 1}}};
    EXPECT_EQ(gap(a, b), 5.0);  // 3 along x, 4 along y
    EXPECT_EQ(gap(a, a), 0.0);
    EXPECT_EQ(joint_diagonal(a, PositionTree::Node{{{1, 2, 1}, {2, 3, 6}}}), 7.0);  // 2, 3 and 6
}

}  // namespace
}  // namespace tetralight::detail
