// SPDX-License-Identifier: Apache-2.0
#include "probes/build/detail/hilbert.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/support/random_probes.h"

namespace tetralight::detail {
namespace {

TEST(Hilbert, NeighborsOnTheCurveAreNeighborsInSpace) {
    // The coarsest 8³ blocks of the curve: consecutive ones share a face.
    constexpr uint32_t kBlock = 1u << 18;
    std::map<uint64_t, std::array<uint32_t, 3>> blocks;
    for (uint32_t x = 0; x < 8; ++x) {
        for (uint32_t y = 0; y < 8; ++y) {
            for (uint32_t z = 0; z < 8; ++z) {
                blocks[hilbert_index({x * kBlock, y * kBlock, z * kBlock}) >> 54] = {x, y, z};
            }
        }
    }
    ASSERT_EQ(blocks.size(), 512u);
    for (uint64_t i = 1; i < 512; ++i) {
        uint32_t steps = 0;
        for (int axis = 0; axis < 3; ++axis) {
            steps += static_cast<uint32_t>(std::abs(static_cast<int>(blocks[i][axis]) -
                                                    static_cast<int>(blocks[i - 1][axis])));
        }
        EXPECT_EQ(steps, 1u) << i;
    }
}

TEST(Hilbert, OrderVisitsEachPositionOnce) {
    std::vector<uint32_t> order = hilbert_order(test::random_positions(1000, 1));
    std::ranges::sort(order);
    for (uint32_t i = 0; i < 1000; ++i) EXPECT_EQ(order[i], i);
}

TEST(Hilbert, OrderDoesNotDependOnTheInputOrder) {
    std::vector<glm::dvec3> positions = test::random_positions(200, 2);
    positions.push_back(positions[7]);  // equal positions, and so equal keys
    std::vector<glm::dvec3> reversed(positions.rbegin(), positions.rend());
    const auto order = hilbert_order(positions);
    const auto reversed_order = hilbert_order(reversed);
    for (size_t i = 0; i < order.size(); ++i) {
        EXPECT_EQ(positions[order[i]], reversed[reversed_order[i]]);
    }
}

TEST(Hilbert, OrderOfOnePlaceIsDefined) {
    EXPECT_EQ(hilbert_order(std::vector<glm::dvec3>(3, glm::dvec3(5.0))).size(), 3u);
    EXPECT_TRUE(hilbert_order({}).empty());
}

}  // namespace
}  // namespace tetralight::detail
