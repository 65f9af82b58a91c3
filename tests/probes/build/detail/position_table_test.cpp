// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/position_table.h>

#include <gtest/gtest.h>

#include <tetralight/probes/no_index.h>
#include "tests/support/random_probes.h"

namespace tetralight::detail {
namespace {

TEST(PositionTable, FindsEveryPositionAndNoOther) {
    const auto positions = test::random_positions(1000, 1);
    const PositionTable table(positions);
    for (uint32_t i = 0; i < positions.size(); ++i) EXPECT_EQ(table.find(positions[i]), i);
    for (const glm::dvec3& p : test::random_positions(1000, 2)) EXPECT_EQ(table.find(p), kNoIndex);
}

TEST(PositionTable, TakesBothZerosForOne) {
    const std::vector<glm::dvec3> positions{{0.0, 1.0, -0.0}};
    EXPECT_EQ(PositionTable(positions).find({-0.0, 1.0, 0.0}), 0u);
}

TEST(PositionTable, OfNothingFindsNothing) {
    EXPECT_EQ(PositionTable({}).find({0, 0, 0}), kNoIndex);
}

}  // namespace
}  // namespace tetralight::detail
