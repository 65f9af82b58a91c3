// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/probe_grid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "tests/bake/placement/grid_support.h"

namespace tetralight {
namespace {

using test::error_of;
using test::grid_of;
using test::layers;
using test::positions_of;
using test::settings_for;

const WorldBox kFour{{-2, -2, -2}, {2, 2, 2}};

/// A solid box in the middle of `kFour`.
Scene solid_in_the_middle() {
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward, {-1, -1, -1},
                  {1, 1, 1});
    return scene;
}

/// The share of free space that is covered.
double covered(const ProbeGrid& grid) {
    return grid.coverage.share(Cover::Covered);
}

TEST(ProbeGrid, ReachesTheSidesOfItsBounds) {
    // The layers at ±1.5 are taken to the sides.
    const ProbeGrid grid = grid_of(Scene{}, settings_for(kFour, 1.0));
    EXPECT_EQ(grid.candidate_count, 64u);
    EXPECT_EQ(grid.count(Fate::Kept), 8u);
    EXPECT_EQ(grid.count(Fate::Pushed), 56u);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(layers(grid, axis), (std::vector<double>{-2.0, -0.5, 0.5, 2.0}));
    }
    EXPECT_EQ(covered(grid), 1.0);
}

TEST(ProbeGrid, RoundingOfTheBoundsCostsNoLayer) {
    // 0.3 / 0.1 is 2.9999999999999996 in double, and 4.2f / 0.6 is 6.9999997.
    EXPECT_EQ(grid_of(Scene{}, settings_for({{0, 0, 0}, {0.3, 0.3, 0.3}}, 0.1)).candidate_count,
              27u);
    const double hall{4.2f};
    EXPECT_EQ(layers(grid_of(Scene{}, settings_for({{0, 0, 0}, {hall, 1, 1}}, 0.6)), 0).size(), 7u);
}

TEST(ProbeGrid, SpacingIsPerAxis) {
    ProbeGridSettings settings = settings_for(kFour, 1.0);
    settings.spacing = {1.0, 2.0, 0.5};
    const ProbeGrid grid = grid_of(Scene{}, settings);
    EXPECT_EQ(layers(grid, 0).size(), 4u);
    EXPECT_EQ(layers(grid, 1), (std::vector<double>{-2.0, 2.0}));
    EXPECT_EQ(layers(grid, 2).size(), 8u);
}

TEST(ProbeGrid, ASpacingThatDoesNotDivideTheBoundsHasOneMoreLayer) {
    // 4 m take three layers 1.5 m apart: at ±1.5 and 0.
    const ProbeGrid grid = grid_of(Scene{}, settings_for(kFour, 1.5));
    EXPECT_EQ(layers(grid, 0), (std::vector<double>{-2.0, 0.0, 2.0}));
}

TEST(ProbeGrid, DropsCandidatesInsideASolidAndCountsThem) {
    // Of 4 × 4 × 4 candidates at ±0.5 and ±1.5 the 2 × 2 × 2 at ±0.5 are in the box. Each of the
    // 6 × 2 × 2 before one of its sides is taken to the bounds, and another is added at the box.
    const ProbeGrid grid = grid_of(solid_in_the_middle(), settings_for(kFour, 1.0));
    EXPECT_EQ(grid.count(Fate::Inside), 8u);
    EXPECT_GE(grid.count(Fate::Added), 24u);
    EXPECT_EQ(grid.count(Fate::Pushed), 56u);
    EXPECT_EQ(grid.probe_count() + 8u, grid.candidate_count);
    for (const glm::dvec3& p : positions_of(grid)) {
        EXPECT_GE(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1.1 - 1e-5);
    }
    EXPECT_GE(covered(grid), 0.98);
}

TEST(ProbeGrid, FreeSpaceIsCoveredAndTheRestListed) {
    const ProbeGrid grid = grid_of(solid_in_the_middle(), settings_for(kFour, 1.0));
    EXPECT_EQ(grid.coverage.place_count(), 4096u);
    EXPECT_EQ(grid.uncovered.size(), 4096u - grid.coverage.count(Cover::Covered));
    for (const UncoveredPlace& place : grid.uncovered) {
        EXPECT_NE(place.cover, Cover::Covered);
        const glm::dvec3 p = glm::abs(place.position);
        EXPECT_GE(std::max({p.x, p.y, p.z}), 1.1);
    }
}

TEST(ProbeGrid, OverAnOpenPlaneItReachesFromTheClearanceToTheTop) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 4.0f);
    const ProbeGrid grid = grid_of(scene, {});  // bounds: the plane, and two spacings above it
    EXPECT_EQ(grid.count(Fate::Inside), 0u);
    const std::vector<double> heights = layers(grid, 1);
    ASSERT_EQ(heights.size(), 2u);
    EXPECT_NEAR(heights[0], 0.1, 2e-4);
    EXPECT_EQ(heights[1], 2.0);
    EXPECT_EQ(positions_of(grid).size(), 128u);
}

TEST(ProbeGrid, SpacingsWiderThanTheSceneStillCoverIt) {
    Scene scene = solid_in_the_middle();
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 8.0f, -1.0f);
    const ProbeGrid grid = grid_of(scene, settings_for({{-8, -1, -8}, {8, 3, 8}}, 1000.0));
    EXPECT_GE(covered(grid), 0.97);
    EXPECT_LE(grid.probe_count(), 200u);
    EXPECT_EQ(layers(grid, 0).front(), -8.0);
    EXPECT_EQ(layers(grid, 0).back(), 8.0);
}

TEST(ProbeGrid, ThingsThatMoveNeitherGiveBoundsNorBuryProbes) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 2.0f);
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward, {-9, -9, -9},
                  {9, 9, 9})
        .contributes_gi = false;
    EXPECT_EQ(grid_of(scene, {}).probe_count(), 32u);
}

TEST(ProbeGrid, OrderOfMeshesAndThreadsDoNotMatter) {
    Scene scene = solid_in_the_middle();
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 2.0f, -1.9f);
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(1.0f), {0, 1.5f, 0});
    test::add_sun(scene, LightMode::Mixed, glm::vec3(1.0f));
    ProbeGridSettings settings = settings_for(kFour, 0.4);
    settings.thread_count = 1;
    const ProbeGrid grid = grid_of(scene, settings);
    std::swap(scene.instances[0], scene.instances[1]);
    std::swap(scene.lights[0], scene.lights[1]);
    auto& indices = scene.meshes[0].indices;
    std::rotate(indices.begin(), indices.begin() + 6, indices.end());
    settings.thread_count = 2;
    const ProbeGrid other = grid_of(scene, settings);
    EXPECT_EQ(other.groups, grid.groups);
    EXPECT_EQ(other.spaces, grid.spaces);
    EXPECT_EQ(other.coverage, grid.coverage);
}

TEST(ProbeGrid, GroupHasTheNameAndWorldSpace) {
    ProbeGridSettings settings = settings_for(kFour, 1.0);
    settings.name = "hall";
    const ProbeGroup group = grid_of(Scene{}, settings).groups.at(0);
    EXPECT_EQ(group.name, "hall");
    EXPECT_EQ(group.world_from_group, glm::dmat4(1.0));
}

TEST(ProbeGrid, RejectsSpacingThatIsNoLength) {
    EXPECT_EQ(error_of(Scene{}, settings_for(kFour, 0.0)),
              "spacing 0 along x is not a positive length");
    EXPECT_EQ(error_of(Scene{}, settings_for(kFour, -1.0)),
              "spacing -1 along x is not a positive length");
    EXPECT_EQ(error_of(Scene{}, settings_for(kFour, std::nan(""))),
              "spacing nan along x is not a positive length");
    EXPECT_EQ(error_of(Scene{}, settings_for(kFour, std::numeric_limits<double>::infinity())),
              "spacing inf along x is not a positive length");
}

TEST(ProbeGrid, RejectsBoundsThatAreEmptyOrNotFinite) {
    EXPECT_EQ(error_of(Scene{}, settings_for({{0, 1, 0}, {1, 0, 1}}, 1.0)),
              "bounds 1 to 0 along y are empty or not finite");
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(error_of(Scene{}, settings_for({{0, 0, 0}, {1, 1, inf}}, 1.0)),
              "bounds 0 to inf along z are empty or not finite");
    EXPECT_EQ(error_of(Scene{}, settings_for({{std::nan(""), 0, 0}, {1, 1, 1}}, 1.0)),
              "bounds nan to 1 along x are empty or not finite");
}

TEST(ProbeGrid, RejectsBoundsThatAreAPoint) {
    EXPECT_EQ(error_of(Scene{}, settings_for({{1, 2, 3}, {1, 2, 3}}, 1.0)),
              "bounds are empty: nothing but 1,2,3");
}

TEST(ProbeGrid, RejectsASceneWithoutBounds) {
    EXPECT_EQ(error_of(Scene{}, {}), "the scene has no static geometry to take bounds from");
}

TEST(ProbeGrid, RejectsTooManyCandidatesAndSaysHowMany) {
    EXPECT_EQ(error_of(Scene{}, settings_for({{0, 0, 0}, {1e4, 1e3, 1e3}}, 1.0)),
              "a grid of 10000000000 probes is more than the limit of 10000000");
    // 1e300 layers on each axis overflow even a double.
    EXPECT_EQ(error_of(Scene{}, settings_for({{0, 0, 0}, {1, 1, 1}}, 1e-300)),
              "a grid of inf probes is more than the limit of 10000000");
}

TEST(ProbeGrid, RejectsAGridThatIsAllInside) {
    EXPECT_EQ(error_of(solid_in_the_middle(), settings_for({{-1, -1, -1}, {1, 1, 1}}, 1.0)),
              "no probe is left of 8: 8 inside geometry, 0 too close to it, 0 unreachable, 0 "
              "without light, 0 forbidden");
}

}  // namespace
}  // namespace tetralight
