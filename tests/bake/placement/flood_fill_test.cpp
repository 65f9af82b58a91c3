// SPDX-License-Identifier: Apache-2.0
// What can be reached: `FreeSpaceMap`, and what the grid makes of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <tetralight/bake/placement/free_space_map.h>
#include "tests/bake/placement/grid_support.h"

namespace tetralight {
namespace {

using test::add_box;
using test::error_of;
using test::Facing;
using test::grid_of;
using test::positions_of;
using test::settings_for;

const WorldBox kTen{{-5, -5, -5}, {5, 5, 5}};

/// A hollow box with walls of 20 cm around 3.6 m of air, in the middle of `kTen`.
Scene sealed_box() {
    Scene scene;
    add_box(scene, test::grey(), Facing::Outward, {-2, -2, -2}, {2, 2, 2});
    add_box(scene, test::grey(), Facing::Inward, {-1.8f, -1.8f, -1.8f}, {1.8f, 1.8f, 1.8f});
    return scene;
}

bool is_in_box(const glm::dvec3& p, double half) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < half;
}

size_t count_inside(const ProbeGrid& grid) {
    const auto positions = positions_of(grid);
    return static_cast<size_t>(
        std::ranges::count_if(positions, [](const auto& p) { return is_in_box(p, 1.8); }));
}

TEST(FloodFill, OfASealedBoxTheLargerSideStaysUnlessAskedOtherwise) {
    const ProbeGrid grid = grid_of(sealed_box(), settings_for(kTen, 1.0));
    EXPECT_EQ(count_inside(grid), 0u);
    // Of 4 candidates along an axis in the box, at ±0.5 and ±1.5.
    EXPECT_EQ(grid.count(Fate::Unreachable), 64u);
    ASSERT_EQ(grid.dropped_spaces.size(), 1u);
    EXPECT_EQ(grid.dropped_spaces[0].probe_count, 64u);
    EXPECT_TRUE(is_in_box(grid.dropped_spaces[0].position, 1.8));
}

TEST(FloodFill, ASeedInTheBoxKeepsItsInsideAlone) {
    ProbeGridSettings settings = settings_for(kTen, 1.0);
    settings.from = {{0.1, 0.2, 0.3}};
    const ProbeGrid grid = grid_of(sealed_box(), settings);
    EXPECT_EQ(grid.probe_count(), 64u);
    EXPECT_EQ(count_inside(grid), 64u);
    EXPECT_EQ(grid.groups.size(), 1u);
}

TEST(FloodFill, SeedsOnBothSidesKeepBothAsGroupsOfTheirOwn) {
    ProbeGridSettings settings = settings_for(kTen, 1.0);
    settings.from = {{0, 0, 0}, {4, 4, 4}};
    const ProbeGrid grid = grid_of(sealed_box(), settings);
    ASSERT_EQ(grid.groups.size(), 2u);
    EXPECT_EQ(grid.groups[0].name, "grid space 1");
    EXPECT_GT(grid.groups[0].positions.size(), 500u);
    EXPECT_EQ(grid.groups[1].positions.size(), 64u);
    EXPECT_EQ(grid.count(Fate::Unreachable), 0u);
    settings.from.clear();
    settings.unreachable = UnreachableSpaces::Keep;
    EXPECT_EQ(grid_of(sealed_box(), settings).groups, grid.groups);
}

TEST(FloodFill, RefusesSeedsThatLieInAWallOrOutside) {
    ProbeGridSettings settings = settings_for(kTen, 1.0);
    settings.from = {{1.9, 0, 0}};
    EXPECT_EQ(error_of(sealed_box(), settings), "seed 1.9,0,0 is inside geometry");
    settings.from = {{99, 0, 0}};
    EXPECT_EQ(error_of(sealed_box(), settings), "seed 99,0,0 is outside of the bounds");
}

TEST(FloodFill, ASpaceBetweenTheProbesIsToldOf) {
    // Layers at ±2.5 are none of the box.
    ProbeGridSettings settings = settings_for(kTen, 5.0);
    ProbeGrid grid = grid_of(sealed_box(), settings);
    ASSERT_EQ(grid.empty_spaces.size(), 1u);
    EXPECT_TRUE(is_in_box(grid.empty_spaces[0].position, 1.8));
    EXPECT_FALSE(grid.empty_spaces[0].is_wanted);
    settings.unreachable = UnreachableSpaces::Keep;
    EXPECT_TRUE(grid_of(sealed_box(), settings).empty_spaces.at(0).is_wanted);
    EXPECT_TRUE(grid_of(sealed_box(), settings_for(kTen, 1.0)).empty_spaces.empty());
}

/// A wall across `kTen` with a door of 0.9 × 2 m.
Scene wall_with_door() {
    Scene scene;
    const auto wall = [&](glm::vec3 low, glm::vec3 high) {
        add_box(scene, test::grey(), Facing::Outward, low, high);
    };
    wall({-9, -9, -0.1f}, {-0.45f, 9, 0.1f});
    wall({0.45f, -9, -0.1f}, {9, 9, 0.1f});
    wall({-0.45f, -3, -0.1f}, {0.45f, 9, 0.1f});
    return scene;
}

TEST(FloodFill, ADoorJoinsRoomsEvenWhenTheLatticeIsCoarser) {
    const ProbeGrid grid = grid_of(wall_with_door(), settings_for(kTen, 2.5));
    EXPECT_EQ(grid.groups.size(), 1u);
    EXPECT_EQ(grid.count(Fate::Unreachable), 0u);
    EXPECT_EQ(grid.probe_count(), 64u);
}

TEST(FloodFill, PostsOnASurfaceDoNotJoinItsSides) {
    // The plane of the wall holds a layer of posts.
    Scene scene;
    test::add_floor(scene, test::two_sided(), 20.0f);
    const auto traced = TraceScene::make_static(scene);
    FreeSpaceMap map(*traced, kTen, glm::dvec3(1.0));
    EXPECT_NE(map.space_of({0.3, 1.2, 0.3}), map.space_of({0.3, -1.2, 0.3}));
    EXPECT_EQ(map.space_of({0.3, 1.2, 0.3}), map.space_of({4.3, 4.2, -4.3}));
}

TEST(FloodFill, AProbeInAnOpeningJoinsWhatItSees) {
    // A hole of 20 cm that no line between two posts leads through.
    Scene scene;
    const auto wall = [&](glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
        test::add_quad(scene, test::two_sided(), corner, u, v);
    };
    wall({-20, -20, 0.02f}, {20.15f, 0, 0}, {0, 40, 0});
    wall({0.35f, -20, 0.02f}, {20, 0, 0}, {0, 40, 0});
    wall({0.15f, -20, 0.02f}, {0.2f, 0, 0}, {0, 20.15f, 0});
    wall({0.15f, 0.35f, 0.02f}, {0.2f, 0, 0}, {0, 20, 0});
    const auto traced = TraceScene::make_static(scene);
    FreeSpaceMap map(*traced, kTen, glm::dvec3(1.0));
    const glm::dvec3 front(2, 2, 2), back(2, 2, -2), hole(0.25, 0.25, 0.02);
    EXPECT_NE(map.space_of(front), map.space_of(back));
    map.join(std::span(&hole, 1));
    EXPECT_EQ(map.space_of(front), map.space_of(back));
}

TEST(FloodFill, WithoutAFloorAllAirIsOneSpace) {
    Scene scene;
    add_box(scene, test::grey(), Facing::Outward, {-1, -1, -1}, {1, 1, 1});
    const ProbeGrid grid = grid_of(scene, settings_for(kTen, 1.0));
    EXPECT_EQ(grid.groups.size(), 1u);
    EXPECT_EQ(grid.probe_count() + grid.count(Fate::Inside), 1000u);
}

}  // namespace
}  // namespace tetralight
