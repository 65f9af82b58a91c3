// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/hilbert_order.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random_probes.h"

namespace tetralight::detail {
namespace {

TEST(HilbertOrder, VisitsEachPositionOnce) {
    std::vector<uint32_t> order = hilbert_order(test::random_positions(1000, 1));
    std::ranges::sort(order);
    for (uint32_t i = 0; i < 1000; ++i) EXPECT_EQ(order[i], i);
}

TEST(HilbertOrder, DoesNotDependOnTheInputOrder) {
    std::vector<glm::dvec3> positions = test::random_positions(200, 2);
    positions.push_back(positions[7]);  // equal positions, and so equal keys
    std::vector<glm::dvec3> reversed(positions.rbegin(), positions.rend());
    const auto order = hilbert_order(positions);
    const auto reversed_order = hilbert_order(reversed);
    for (size_t i = 0; i < order.size(); ++i) {
        EXPECT_EQ(positions[order[i]], reversed[reversed_order[i]]);
    }
}

TEST(HilbertOrder, OfARoomDoesNotChangeWithAProbeFarAway) {
    // The whole room is then one point of the curve through all.
    std::vector<glm::dvec3> positions = test::random_positions(200, 3);
    const std::vector<uint32_t> order = hilbert_order(positions);
    positions.emplace_back(1e12, 1e12, 1e12);
    std::vector<uint32_t> with_outlier = hilbert_order(positions);
    std::erase(with_outlier, 200u);
    EXPECT_EQ(with_outlier, order);
}

TEST(HilbertOrder, OfOnePlaceIsDefined) {
    EXPECT_EQ(hilbert_order(std::vector<glm::dvec3>(3, glm::dvec3(5.0))).size(), 3u);
    EXPECT_TRUE(hilbert_order({}).empty());
}

}  // namespace
}  // namespace tetralight::detail
