// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/group_by_region.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

const std::vector<glm::dvec3> kThree{{0.5, 0, 0}, {7, 0, 0}, {-1, 0, 0}};

TEST(GroupByRegion, OneSpaceIsOneGroupOfThePlainName) {
    const auto regions = group_by_region(kThree, std::vector<uint32_t>{4, 4, 4}, {"hall", 0.0});
    ASSERT_EQ(regions.groups.size(), 1u);
    EXPECT_EQ(regions.groups[0].name, "hall");
    EXPECT_EQ(regions.groups[0].positions, kThree);
    EXPECT_EQ(regions.order, (std::vector<uint32_t>{0, 1, 2}));
}

TEST(GroupByRegion, SpacesCountFromTheLargest) {
    const auto regions = group_by_region(kThree, std::vector<uint32_t>{1, 9, 9}, {"hall", 0.0});
    ASSERT_EQ(regions.groups.size(), 2u);
    EXPECT_EQ(regions.groups[0].name, "hall space 1");
    EXPECT_EQ(regions.groups[0].positions, (std::vector<glm::dvec3>{kThree[1], kThree[2]}));
    EXPECT_EQ(regions.groups[1].name, "hall space 2");
    EXPECT_EQ(regions.order, (std::vector<uint32_t>{1, 2, 0}));
}

TEST(GroupByRegion, CubesCountFromTheOrigin) {
    const auto regions = group_by_region(kThree, std::vector<uint32_t>{0, 0, 0}, {"hall", 4.0});
    ASSERT_EQ(regions.groups.size(), 3u);
    EXPECT_EQ(regions.groups[0].name, "hall -1,0,0");
    EXPECT_EQ(regions.groups[1].name, "hall 0,0,0");
    EXPECT_EQ(regions.groups[2].name, "hall 1,0,0");
}

}  // namespace
}  // namespace tetralight
