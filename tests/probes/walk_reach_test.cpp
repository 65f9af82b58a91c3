// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/walk_reach.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include <tetralight/probes/locate.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

/// Visits what a walk from `start` to a position visits in any case: cells in which it can end.
TEST(WalkReach, HasTheCellInWhichEachWalkEnds) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(1000, 1));
    WalkReach reach(volume.view());
    const auto centers = test::random_positions(200, 2, 1.05);
    const auto offsets = test::random_positions(50, 3, 0.05);
    for (const glm::dvec3& center : centers) {
        const glm::dvec3 local = center - volume.info.world_origin;
        const Box<glm::dvec3> region{local - 0.0501, local + 0.0501};
        const uint32_t start = locate(volume.view(), glm::vec3(center)).cell;
        const auto cells = reach.cells_from(start, region);
        for (const glm::dvec3& offset : offsets) {
            const glm::vec3 position(center + offset);
            const uint32_t end = locate(volume.view(), position, start).cell;
            ASSERT_NE(std::ranges::find(cells, end), cells.end());
        }
    }
}

TEST(WalkReach, StaysNearSmallBoxes) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(5000, 4));
    WalkReach reach(volume.view());
    size_t sum = 0;
    const auto centers = test::random_positions(300, 5, 0.8);
    for (const glm::dvec3& center : centers) {
        const glm::dvec3 local = center - volume.info.world_origin;
        const uint32_t start = locate(volume.view(), glm::vec3(center)).cell;
        sum += reach.cells_from(start, {local - 1e-4, local + 1e-4}).size();
    }
    EXPECT_LT(sum, 2 * centers.size()) << "most of such boxes lie in one cell";
}

TEST(MayTouch, IsTrueForPositionsInsideAndFalseFarAway) {
    const ProbeVolume volume = test::make_lit_volume({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    const glm::dvec3 origin = volume.info.world_origin;
    const auto box = [&](glm::dvec3 center, double half) {
        return Box<glm::dvec3>{center - half - origin, center + half - origin};
    };
    EXPECT_TRUE(may_touch(volume.view(), 0, box({0.2, 0.2, 0.2}, 0.01)));
    EXPECT_TRUE(may_touch(volume.view(), 0, box({0.5, 0.5, 0.5}, 1.0)));
    EXPECT_FALSE(may_touch(volume.view(), 0, box({2.0, 0.2, 0.2}, 0.5)));
    // In the box of the tetrahedron, beyond its slanted face.
    EXPECT_FALSE(may_touch(volume.view(), 0, box({0.8, 0.8, 0.8}, 0.1)));
}

}  // namespace
}  // namespace tetralight
