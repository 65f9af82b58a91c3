// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/morton_order.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

std::vector<uint32_t> order_of(std::span<const glm::vec3> positions) {
    std::vector<uint64_t> memory(2 * positions.size());
    std::vector<uint32_t> order;
    for (const uint64_t key : morton_order(positions, memory)) {
        order.push_back(static_cast<uint32_t>(key));
    }
    return order;
}

std::vector<glm::vec3> random_floats(size_t count) {
    std::vector<glm::vec3> positions;
    for (const glm::dvec3& p : test::random_positions(count, 1)) positions.emplace_back(p);
    return positions;
}

TEST(MortonOrder, NamesEveryPositionOnce) {
    for (const size_t count : {0u, 1u, 2u, 7u, 1000u, 100000u}) {
        std::vector<uint32_t> order = order_of(random_floats(count));
        std::ranges::sort(order);
        for (uint32_t i = 0; i < count; ++i) ASSERT_EQ(order[i], i);
        EXPECT_EQ(order.size(), count);
    }
}

/// Of the eight octants of a cube, z changes fastest, then y, then x.
TEST(MortonOrder, VisitsTheOctantsInTurn) {
    std::vector<glm::vec3> corners;
    for (int i = 7; i >= 0; --i) corners.emplace_back(i >> 2 & 1, i >> 1 & 1, i & 1);
    const std::vector<uint32_t> backwards{7, 6, 5, 4, 3, 2, 1, 0};
    EXPECT_EQ(order_of(corners), backwards);
}

TEST(MortonOrder, BringsNeighborsTogether) {
    const std::vector<glm::vec3> positions = random_floats(10000);
    const auto path = [&](const std::vector<uint32_t>& order) {
        double length = 0.0;
        for (size_t i = 1; i < order.size(); ++i) {
            length +=
                static_cast<double>(glm::distance(positions[order[i]], positions[order[i - 1]]));
        }
        return length;
    };
    std::vector<uint32_t> any(positions.size());
    for (uint32_t i = 0; i < any.size(); ++i) any[i] = i;
    EXPECT_LT(path(order_of(positions)), path(any) / 10.0);
}

TEST(MortonOrder, TakesFlatSetsAndPositionsThatAreNotFinite) {
    std::vector<glm::vec3> positions = random_floats(100);
    for (glm::vec3& p : positions) p.y = 5.0f;
    positions[17].x = std::numeric_limits<float>::quiet_NaN();
    positions[18].z = std::numeric_limits<float>::infinity();
    positions[19].x = std::numeric_limits<float>::max();
    positions[20].x = std::numeric_limits<float>::lowest();
    EXPECT_EQ(order_of(positions).size(), 100u);
    const std::vector<glm::vec3> one_place(50, glm::vec3(1.0f));
    EXPECT_EQ(order_of(one_place)[49], 49u);
}

}  // namespace
}  // namespace tetralight
