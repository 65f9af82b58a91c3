// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/affine_dimension.h>

#include <gtest/gtest.h>

#include <vector>

namespace tetralight {
namespace {

TEST(AffineDimension, GrowsWithEachPositionOffWhatWasSpannedBefore) {
    std::vector<glm::dvec3> positions;
    EXPECT_EQ(affine_dimension(positions), -1);
    positions.assign(2, {5, 6, 7});
    EXPECT_EQ(affine_dimension(positions), 0);
    positions.emplace_back(7, 8, 9);
    positions.emplace_back(8, 9, 10);
    EXPECT_EQ(affine_dimension(positions), 1);
    positions.emplace_back(6, 6, 7);
    positions.emplace_back(4, 6, 7);
    EXPECT_EQ(affine_dimension(positions), 2);
    positions.emplace_back(5, 6.1, 7);
    EXPECT_EQ(affine_dimension(positions), 3);
}

TEST(AffineDimension, OfRoundedLatticesIsThatOfTheLattice) {
    std::vector<glm::dvec3> plane;
    for (int i = 0; i < 12; ++i) plane.emplace_back(i % 4, i / 4, i % 2 == 0 ? 0.0 : 1e-9);
    EXPECT_EQ(affine_dimension(plane), 2);
}

}  // namespace
}  // namespace tetralight
