// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/reach_walls.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/bake/placement/grid_support.h"

namespace tetralight {
namespace {

using test::add_box;
using test::Facing;

constexpr double kClearance = 0.1;
/// Positions may be farther from a wall than the clearance by this, metres.
constexpr double kSlack = 3e-4;

/// Bounds that nothing reaches.
ReachRule rule_in(const WorldBox& bounds = {{-99, -99, -99}, {99, 99, 99}}) {
    return {bounds, kClearance, glm::bvec3(true), {}};
}

/// A room of 4 × 3 × 4 m.
Scene room() {
    Scene scene;
    add_box(scene, test::grey(), Facing::Inward, {0, 0, 0}, {4, 3, 4});
    return scene;
}

std::vector<glm::dvec3> reached(const Scene& scene, const glm::dvec3& position,
                                const ReachRule& rule = rule_in()) {
    const auto traced = TraceScene::make_static(scene);
    return reach_walls(*traced, position, glm::dvec3(1.0), rule);
}

void expect_near(const glm::dvec3& position, const glm::dvec3& expected) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(position[axis], expected[axis], kSlack);
}

TEST(ReachWalls, ALatticePositionGoesToTheCornerOfARoom) {
    const auto found = reached(room(), {0.5, 2.6, 3.7});
    ASSERT_EQ(found.size(), 1u);
    expect_near(found[0], {0.1, 2.9, 3.9});
}

TEST(ReachWalls, StaysInTheMiddleOfARoom) {
    const glm::dvec3 middle(2.0, 1.5, 2.0);
    EXPECT_EQ(reached(room(), middle), std::vector<glm::dvec3>{middle});
}

TEST(ReachWalls, AWallBetweenHalfASpacingAndAWholeOneGetsAPositionOfItsOwn) {
    // The layer at the wall is 0.7 m away.
    const auto found = reached(room(), {0.8, 1.5, 2.0});
    ASSERT_EQ(found.size(), 2u);
    expect_near(found[0], {0.1, 1.5, 2.0});
    EXPECT_EQ(found[1], glm::dvec3(0.8, 1.5, 2.0));
}

TEST(ReachWalls, ANarrowGapKeepsOnePosition) {
    // Of 25 cm, 5 cm have clearance from both walls.
    Scene scene;
    add_box(scene, test::grey(), Facing::Inward, {0, -9, -9}, {0.25f, 9, 9});
    const glm::dvec3 between(0.12, 0.0, 0.0);
    EXPECT_EQ(reached(scene, between), std::vector<glm::dvec3>{between});
}

TEST(ReachWalls, AWiderGapHasALayerAtEachWall) {
    Scene scene;
    add_box(scene, test::grey(), Facing::Inward, {0, -9, -9}, {0.6f, 9, 9});
    const auto found = reached(scene, {0.25, 0.0, 0.0});
    ASSERT_EQ(found.size(), 2u);
    expect_near(found[0], {0.1, 0.0, 0.0});
    expect_near(found[1], {0.5, 0.0, 0.0});
}

TEST(ReachWalls, ASlantedWallKeepsItsClearance) {
    // The plane x + y = 0; its normal is (1, 1, 0) / √2.
    Scene scene;
    test::add_quad(scene, test::two_sided(), {-9, 9, -9}, {18, -18, 0}, {0, 0, 18});
    const auto found = reached(scene, {0.5, 0.25, 0.0});
    double nearest = 1.0;
    for (const glm::dvec3& p : found) {
        const double distance = (p.x + p.y) / std::sqrt(2.0);
        EXPECT_GE(distance, kClearance - 1e-6);
        nearest = std::min(nearest, distance);
    }
    EXPECT_LE(nearest, kClearance + kSlack);
}

TEST(ReachWalls, SidesOfTheBoundsAreReachedExactly) {
    const auto found = reached(Scene{}, {0.3, 0.4, 0.5}, rule_in({{0, 0, 0}, {5, 5, 5}}));
    EXPECT_EQ(found, std::vector<glm::dvec3>{glm::dvec3(0.0)});
}

TEST(ReachWalls, LeavesAxesThatItMayNotUse) {
    ReachRule rule = rule_in();
    rule.axes = {true, false, true};
    const auto found = reached(room(), {0.5, 0.5, 0.5}, rule);
    ASSERT_EQ(found.size(), 1u);
    expect_near(found[0], {0.1, 0.5, 0.1});
}

TEST(ReachWalls, GoesToTheBorderOfWhereProbesMayBe) {
    ReachRule rule = rule_in();
    rule.holds = [](const glm::dvec3& place) { return place.y <= 1.3 && place.x < 2.0; };
    const auto found = reached(Scene{}, {0, 1, 0}, rule);
    ASSERT_EQ(found.size(), 1u);
    constexpr double kBisected = 1e-3;
    EXPECT_NEAR(found[0].y, 1.3, kBisected);
    EXPECT_LE(found[0].y, 1.3);
}

TEST(AlignPlanes, MergesNoiseIntoTheMostFrequentCoordinate) {
    std::vector<glm::dvec3> positions{{0.1, 0, 5}, {0.1, 1, 6}, {0.10003, 2, 7}, {0.09998, 3, 8}};
    align_planes(positions, 1e-3);
    EXPECT_EQ(positions,
              (std::vector<glm::dvec3>{{0.1, 0, 5}, {0.1, 1, 6}, {0.1, 2, 7}, {0.1, 3, 8}}));
}

TEST(AlignPlanes, LeavesOthers) {
    const std::vector<glm::dvec3> apart{{0.1, 0, 0}, {0.102, 0, 0}, {0.104, 0, 0}};
    std::vector<glm::dvec3> positions = apart;
    align_planes(positions, 1e-3);
    EXPECT_EQ(positions, apart);
}

}  // namespace
}  // namespace tetralight
