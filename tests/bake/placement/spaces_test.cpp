// SPDX-License-Identifier: Apache-2.0
// Which spaces a grid fills.
#include <tetralight/bake/placement/spaces.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/bake/placement/grid_support.h"

namespace tetralight {
namespace {

using test::add_box;
using test::error_of;
using test::Facing;
using test::grid_of;
using test::positions_of;
using test::settings_for;

const WorldBox kSix{{-3, -3, -3}, {3, 3, 3}};
/// The body of the flood fill and the clearance, metres: a tenth of the spacing.
constexpr double kRadius = 0.1;

/// A hollow box with walls of 20 cm around 3.6 m of air, in the middle of `kSix`.
Scene sealed_box() {
    Scene scene;
    add_box(scene, test::grey(), Facing::Outward, {-2, -2, -2}, {2, 2, 2});
    add_box(scene, test::grey(), Facing::Inward, {-1.8f, -1.8f, -1.8f}, {1.8f, 1.8f, 1.8f});
    return scene;
}

/// The same under a white sky.
Scene box_under_sky() {
    Scene scene = sealed_box();
    scene.environment.radiance = glm::vec3(1.0f);
    return scene;
}

bool is_in_box(const glm::dvec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 2.0;
}

size_t count_inside(const ProbeGrid& grid) {
    return static_cast<size_t>(std::ranges::count_if(positions_of(grid), is_in_box));
}

/// The space in the box.
Space hollow_of(const ProbeGrid& grid) {
    const auto found = std::ranges::find_if(
        grid.spaces, [](const Space& space) { return is_in_box(space.position); });
    EXPECT_NE(found, grid.spaces.end());
    return found == grid.spaces.end() ? Space{} : *found;
}

TEST(Spaces, OfASealedBoxTheSideWithMoreProbesIsFilled) {
    const ProbeGrid grid = grid_of(sealed_box(), settings_for(kSix, 1.0));
    EXPECT_EQ(count_inside(grid), 0u);
    ASSERT_EQ(grid.spaces.size(), 2u);
    EXPECT_EQ(grid.spaces[0].fate, SpaceFate::Filled);
    EXPECT_EQ(grid.spaces[0].probe_count, grid.probe_count());
    // Of six layers along each axis four are in the box: at ±0.5, and at ±1.5 taken to the walls.
    EXPECT_EQ(grid.spaces[1], hollow_of(grid));
    EXPECT_EQ(grid.spaces[1].fate, SpaceFate::Unreachable);
    EXPECT_EQ(grid.spaces[1].probe_count, 64u);
    EXPECT_EQ(grid.count(Fate::Unreachable), 64u);
}

TEST(Spaces, TheirVolumeIsThatOfTheBodysCenter) {
    const ProbeGrid grid = grid_of(sealed_box(), settings_for(kSix, 1.0));
    // Measured in steps of 25 cm: as if the box was up to a step longer or shorter.
    const double side = 3.6 - 2.0 * kRadius;
    EXPECT_GT(hollow_of(grid).volume, std::pow(side - 0.25, 3));
    EXPECT_LT(hollow_of(grid).volume, std::pow(side + 0.25, 3));
    const double hole = std::pow(4.0 + 2.0 * kRadius, 3);
    EXPECT_GT(grid.spaces.at(0).volume, std::pow(5.75, 3) - 1.2 * hole);
    EXPECT_LT(grid.spaces[0].volume, std::pow(6.25, 3) - 0.8 * hole);
}

TEST(Spaces, ASeedInTheBoxKeepsItsInsideAlone) {
    ProbeGridSettings settings = settings_for(kSix, 1.0);
    settings.from = {{0.1, 0.2, 0.3}};
    const ProbeGrid grid = grid_of(sealed_box(), settings);
    EXPECT_GE(grid.probe_count(), 64u);
    EXPECT_EQ(count_inside(grid), grid.probe_count());
    EXPECT_EQ(grid.groups.size(), 1u);
    EXPECT_TRUE(hollow_of(grid).has_seed);
    EXPECT_EQ(hollow_of(grid).fate, SpaceFate::Filled);
    EXPECT_GE(grid.coverage.share(Cover::Covered), 0.99);
}

TEST(Spaces, SeedsOnBothSidesKeepBothAsGroupsOfTheirOwn) {
    ProbeGridSettings settings = settings_for(kSix, 1.0);
    settings.from = {{0, 0, 0}, {2.5, 2.5, 2.5}};
    const ProbeGrid grid = grid_of(sealed_box(), settings);
    ASSERT_EQ(grid.groups.size(), 2u);
    EXPECT_EQ(grid.groups[0].name, "grid space 1");
    EXPECT_GT(grid.groups[0].positions.size(), 152u);
    EXPECT_EQ(grid.groups[1].positions.size(), count_inside(grid));
    EXPECT_GE(count_inside(grid), 64u);
    EXPECT_EQ(grid.count(Fate::Unreachable), 0u);
    settings.from.clear();
    settings.unreachable = UnreachableSpaces::Keep;
    EXPECT_EQ(grid_of(sealed_box(), settings).groups.size(), 2u);
}

TEST(Spaces, SeedsInAWallOutsideOrInANarrowGapAreRefused) {
    ProbeGridSettings settings = settings_for(kSix, 1.0);
    settings.from = {{1.9, 0, 0}};
    EXPECT_EQ(error_of(sealed_box(), settings), "seed 1.9,0,0 is inside geometry");
    settings.from = {{99, 0, 0}};
    EXPECT_EQ(error_of(sealed_box(), settings), "seed 99,0,0 is outside of the bounds");
    Scene scene = sealed_box();  // 10 cm above the floor of the box
    test::add_quad(scene, test::two_sided(), {-1.9f, -1.7f, -1.9f}, {0, 0, 3.8f}, {3.8f, 0, 0});
    settings.from = {{0, -1.75, 0}};
    EXPECT_EQ(error_of(scene, settings),
              "seed 0,-1.75,0 is in a gap that is too narrow for the flood fill");
}

TEST(Spaces, ADarkHollowIsLeftOut) {
    ProbeGridSettings settings = settings_for(kSix, 1.0);
    settings.unreachable = UnreachableSpaces::Keep;
    const ProbeGrid grid = grid_of(box_under_sky(), settings);
    EXPECT_EQ(count_inside(grid), 0u);
    EXPECT_EQ(grid.count(Fate::Dark), 64u);
    EXPECT_EQ(hollow_of(grid).fate, SpaceFate::Dark);
    EXPECT_TRUE(hollow_of(grid).light.is_dark());
    EXPECT_EQ(grid.spaces.at(0).light, (SpaceLight{.has_sky = true, .has_lights = false}));
}

TEST(Spaces, ADarkHollowIsKeptIfAskedFor) {
    ProbeGridSettings settings = settings_for(kSix, 1.0);
    settings.dark = DarkSpaces::Keep;
    const ProbeGrid both = grid_of(box_under_sky(), settings);
    EXPECT_GE(count_inside(both), 64u);
    EXPECT_GT(both.probe_count(), count_inside(both));
    settings = settings_for(kSix, 1.0);
    settings.from = {{0.1, 0.2, 0.3}};
    const ProbeGrid seeded = grid_of(box_under_sky(), settings);
    EXPECT_GE(count_inside(seeded), 64u);
    EXPECT_EQ(count_inside(seeded), seeded.probe_count());
}

TEST(Spaces, DarkOnesAreFilledBesideTheLitOneNotInItsPlace) {
    Scene scene = sealed_box();  // light in the hollow alone, which is smaller
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(1.0f), {0.1f, 0.2f, 0.3f});
    ProbeGridSettings settings = settings_for(kSix, 1.0);
    settings.dark = DarkSpaces::Keep;
    const ProbeGrid grid = grid_of(scene, settings);
    EXPECT_GE(count_inside(grid), 64u);
    EXPECT_GT(grid.probe_count(), count_inside(grid));
}

TEST(Spaces, ABodyWiderThanTheClearanceStillReachesProbesInCorners) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_box(scene, test::two_sided(), test::Facing::Inward, {0, 0, 0}, {4, 3, 4});
    ProbeGridSettings settings = settings_for({{0, 0, 0}, {4, 3, 4}}, 1.0);
    settings.from = {{2, 1.5, 2}};
    const uint64_t count = grid_of(scene, settings).probe_count();
    settings.agent_radius = 0.35;
    const ProbeGrid grid = grid_of(scene, settings);
    EXPECT_EQ(grid.probe_count(), count);
    EXPECT_EQ(grid.count(Fate::Unreachable), 0u);
}

TEST(Spaces, TheLitOneIsFilledEvenIfItIsSmaller) {
    // Light of any mode counts, also what bakes leave to the game.
    for (const LightMode mode : {LightMode::Baked, LightMode::Mixed}) {
        Scene scene = sealed_box();
        test::add_point_light(scene, mode, glm::vec3(1.0f), {0.1f, 0.2f, 0.3f});
        const ProbeGrid grid = grid_of(scene, settings_for(kSix, 1.0));
        EXPECT_EQ(count_inside(grid), grid.probe_count());
        EXPECT_EQ(hollow_of(grid).light, (SpaceLight{.has_sky = false, .has_lights = true}));
        EXPECT_GE(grid.count(Fate::Dark), 152u);
    }
}

TEST(Spaces, LightThroughACrackDoesNotCount) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    // A closed box of sheets whose lid leaves a crack of 1 mm along one edge.
    const Material sheet = test::two_sided();
    test::add_quad(scene, sheet, {-2, -2, -2}, {4, 0, 0}, {0, 0, 4});
    test::add_quad(scene, sheet, {-2, 2, -2}, {3.999f, 0, 0}, {0, 0, 4});
    for (const float side : {-2.0f, 2.0f}) {
        test::add_quad(scene, sheet, {side, -2, -2}, {0, 4, 0}, {0, 0, 4});
        test::add_quad(scene, sheet, {-2, -2, side}, {4, 0, 0}, {0, 4, 0});
    }
    const ProbeGrid grid = grid_of(scene, settings_for(kSix, 1.0));
    EXPECT_EQ(count_inside(grid), 0u);
    EXPECT_EQ(hollow_of(grid).fate, SpaceFate::Dark);
}

TEST(Spaces, ASpaceBetweenTheLayersIsListedAndFilledIfAsked) {
    // Layers at ±2.5 miss the box.
    ProbeGridSettings settings = settings_for({{-5, -5, -5}, {5, 5, 5}}, 5.0);
    const ProbeGrid grid = grid_of(sealed_box(), settings);
    EXPECT_EQ(hollow_of(grid).probe_count, 0u);
    EXPECT_EQ(hollow_of(grid).fate, SpaceFate::Unreachable);
    settings.unreachable = UnreachableSpaces::Keep;
    const ProbeGrid both = grid_of(sealed_box(), settings);
    EXPECT_EQ(hollow_of(both).fate, SpaceFate::Filled);
    EXPECT_EQ(hollow_of(both).probe_count, count_inside(both));
    EXPECT_GE(count_inside(both), 1u);
    EXPECT_GE(both.coverage.share(Cover::Covered), 0.97);
}

/// A wall across `kSix` with a door of 0.9 × 2 m.
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

TEST(Spaces, ADoorJoinsRoomsEvenIfTheLatticeIsCoarser) {
    const ProbeGrid grid = grid_of(wall_with_door(), settings_for(kSix, 2.5));
    EXPECT_EQ(grid.groups.size(), 1u);
    EXPECT_EQ(grid.spaces.size(), 1u);
    EXPECT_EQ(grid.count(Fate::Unreachable), 0u);
    EXPECT_GE(grid.coverage.share(Cover::Covered), 0.97);
}

TEST(Spaces, ABodyThatIsTooWideForADoorStaysInOneRoom) {
    ProbeGridSettings settings = settings_for(kSix, 2.5);
    settings.agent_radius = 0.5;
    const ProbeGrid grid = grid_of(wall_with_door(), settings);
    EXPECT_GT(grid.count(Fate::Unreachable), 0u);
    const bool is_front = positions_of(grid).front().z > 0.0;
    for (const glm::dvec3& p : positions_of(grid)) EXPECT_EQ(p.z > 0.0, is_front);
    settings.agent_radius = -0.5;
    EXPECT_EQ(error_of(wall_with_door(), settings), "agent_radius -0.5 is not a length");
}

TEST(Spaces, WithoutAFloorAllAirIsOneSpace) {
    Scene scene;
    add_box(scene, test::grey(), Facing::Outward, {-1, -1, -1}, {1, 1, 1});
    const ProbeGrid grid = grid_of(scene, settings_for(kSix, 1.0));
    EXPECT_EQ(grid.groups.size(), 1u);
    EXPECT_EQ(grid.spaces.size(), 1u);
    EXPECT_EQ(grid.probe_count() + grid.count(Fate::Inside), grid.candidate_count);
    EXPECT_EQ(grid.count(Fate::Inside), 8u);
}

}  // namespace
}  // namespace tetralight
