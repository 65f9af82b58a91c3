// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/candidates.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/bake/placement/grid_support.h"

namespace tetralight {
namespace {

using test::add_box;
using test::Facing;

CandidateRule rule_for(const WorldBox& bounds, double spacing) {
    CandidateRule rule;
    rule.bounds = bounds;
    rule.spacing = glm::dvec3(spacing);
    rule.clearance = 0.1;
    rule.heights = {0.5, 1.5};
    rule.max_count = 1000000;
    return rule;
}

std::vector<glm::dvec3> layers_over(const Scene& scene, const CandidateRule& rule) {
    const auto traced = TraceScene::make_static(scene);
    const auto found = layer_candidates(*traced, rule);
    EXPECT_TRUE(found) << error_text(found.error());
    return *found;
}

std::multiset<double> heights_of(const std::vector<glm::dvec3>& candidates) {
    std::multiset<double> heights;
    for (const auto& p : candidates) heights.insert(std::round(p.y * 1000.0) / 1000.0);
    return heights;
}

TEST(LayerCandidates, StandAboveEveryStorey) {
    Scene scene;
    for (const float y : {0.0f, 3.0f}) {
        add_box(scene, test::grey(), Facing::Outward, {-2, y - 0.2f, -2}, {2, y, 2});
    }
    const auto found = layers_over(scene, rule_for({{-2, -0.2, -2}, {2, 5, 2}}, 2.0));
    // Four columns, each with two heights over two floors.
    EXPECT_EQ(heights_of(found), (std::multiset<double>{0.5, 0.5, 0.5, 0.5, 1.5, 1.5, 1.5, 1.5, 3.5,
                                                        3.5, 3.5, 3.5, 4.5, 4.5, 4.5, 4.5}));
}

TEST(LayerCandidates, FindNoRoomAboveALowCeiling) {
    Scene scene;
    test::add_floor(scene, test::grey(), 5.0f);
    test::add_ceiling(scene, test::grey(), 5.0f, 1.0f);
    const auto found = layers_over(scene, rule_for({{-2, 0, -2}, {2, 1, 2}}, 2.0));
    EXPECT_EQ(heights_of(found), (std::multiset<double>{0.5, 0.5, 0.5, 0.5}));
}

TEST(LayerCandidates, StayBelowTheUpperEndOfTheBounds) {
    Scene scene;
    test::add_floor(scene, test::grey(), 5.0f);
    const auto found = layers_over(scene, rule_for({{-2, 0, -2}, {2, 1, 2}}, 2.0));
    EXPECT_EQ(heights_of(found), (std::multiset<double>{0.5, 0.5, 0.5, 0.5}));
}

TEST(LayerCandidates, SteepAndDownwardSurfacesAreNoFloors) {
    Scene scene;
    test::add_ceiling(scene, test::two_sided(), 5.0f, 3.0f);  // two-sided: a floor from above
    test::add_quad(scene, test::grey(), {-5, 0, -5}, {0, 0, 10}, {5, 10, 0});  // 63° steep
    const auto found = layers_over(scene, rule_for({{-4, 0, -4}, {4, 10, 4}}, 4.0));
    const auto heights = heights_of(found);
    EXPECT_EQ(std::set<double>(heights.begin(), heights.end()), (std::set<double>{3.5, 4.5}));
}

TEST(LayerCandidates, ASceneWithoutAFloorIsAnError) {
    Scene scene;
    test::add_ceiling(scene, test::grey(), 5.0f, 3.0f);
    const auto traced = TraceScene::make_static(scene);
    const auto found = layer_candidates(*traced, rule_for({{-2, 0, -2}, {2, 3, 2}}, 2.0));
    ASSERT_FALSE(found);
    EXPECT_EQ(error_text(found.error()),
              "there is no floor, or no room above it in the bounds, in any of 4 columns");
}

WalkableSurface walkable_square(double half_size, double y) {
    const glm::dvec3 a(-half_size, y, -half_size), b(-half_size, y, half_size);
    const glm::dvec3 c(half_size, y, half_size), d(half_size, y, -half_size);
    const WorldTriangle triangles[] = {{a, b, c}, {a, c, d}};
    return *WalkableSurface::make(triangles);
}

TEST(LayerCandidates, TakeTheWalkableSurfaceAsTheOnlyFloor) {
    Scene scene;
    test::add_floor(scene, test::grey(), 5.0f);
    test::add_floor(scene, test::grey(), 5.0f, 4.0f);
    // Of the 16 columns at ±1 and ±3, four are over the walkable square, which lies a little below
    // the lower floor and below the bounds.
    const WalkableSurface walkable = walkable_square(2.0, -0.02);
    CandidateRule rule = rule_for({{-4, 0, -4}, {4, 6, 4}}, 2.0);
    rule.walkable = &walkable;
    EXPECT_EQ(heights_of(layers_over(scene, rule)),
              (std::multiset<double>{0.48, 0.48, 0.48, 0.48, 1.48, 1.48, 1.48, 1.48}));
}

TEST(LayerCandidates, FindNoRoomAboveAWalkableSurfaceBelowALowCeiling) {
    Scene scene;
    test::add_ceiling(scene, test::grey(), 5.0f, 1.0f);
    const WalkableSurface walkable = walkable_square(2.0, 0.0);
    CandidateRule rule = rule_for({{-2, 0, -2}, {2, 3, 2}}, 2.0);
    rule.walkable = &walkable;
    EXPECT_EQ(heights_of(layers_over(scene, rule)), (std::multiset<double>{0.5, 0.5, 0.5, 0.5}));
}

TEST(LayerCandidates, BesideTheWalkableSurfaceAreAnError) {
    Scene scene;
    test::add_floor(scene, test::grey(), 5.0f);
    const auto traced = TraceScene::make_static(scene);
    const WalkableSurface walkable = walkable_square(0.5, 0.0);
    CandidateRule rule = rule_for({{2, 0, 2}, {4, 3, 4}}, 2.0);
    rule.walkable = &walkable;
    const auto found = layer_candidates(*traced, rule);
    ASSERT_FALSE(found);
    EXPECT_EQ(
        error_text(found.error()),
        "there is no walkable surface, or no room above it in the bounds, in any of 4 columns");
}

TEST(SurfaceCandidates, StandOnBothSidesAtTheClearance) {
    Scene scene;
    test::add_floor(scene, test::grey(), 2.0f, 1.0f);
    const auto traced = TraceScene::make_static(scene);
    const auto found = surface_candidates(*traced, rule_for({{-2, 0, -2}, {2, 2, 2}}, 1.0));
    ASSERT_TRUE(found);
    ASSERT_EQ(found->size(), 32u);
    for (const glm::dvec3& p : *found) EXPECT_NEAR(std::abs(p.y - 1.0), 0.1, 1e-6);
}

TEST(SurfaceCandidates, FollowWallsOfAllDirections) {
    Scene scene;
    add_box(scene, test::grey(), Facing::Outward, {-1, -1, -1}, {1, 1, 1});
    const auto traced = TraceScene::make_static(scene);
    const auto found =
        surface_candidates(*traced, rule_for({{-1.1, -1.1, -1.1}, {1.1, 1.1, 1.1}}, 1.1));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->size(), 6u * 4u * 2u);
    for (const glm::dvec3& p : *found) {
        const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        EXPECT_NEAR(std::abs(farthest - 1.0), 0.1, 1e-6);
    }
}

TEST(SurfaceCandidates, LeaveOutTheSideBeyondTheBounds) {
    Scene scene;
    test::add_floor(scene, test::two_sided(), 2.0f);
    const auto traced = TraceScene::make_static(scene);
    const auto found = surface_candidates(*traced, rule_for({{-2, 0, -2}, {2, 2, 2}}, 1.0));
    ASSERT_TRUE(found);
    ASSERT_EQ(found->size(), 16u);
    for (const glm::dvec3& p : *found) EXPECT_NEAR(p.y, 0.1, 1e-6);
}

TEST(Crowded, FlagsTheSecondOfTwoThatSeeEachOther) {
    Scene scene;
    test::add_floor(scene, test::two_sided(), 5.0f);
    const auto traced = TraceScene::make_static(scene);
    const std::vector<glm::dvec3> positions{{0, 0.1, 0}, {0.3, 0.1, 0}, {0, -0.1, 0}, {1, 0.1, 0}};
    EXPECT_EQ(find_crowded(*traced, positions, 0.5),
              (std::vector<bool>{false, true, false, false}));
}

}  // namespace
}  // namespace tetralight
