// SPDX-License-Identifier: Apache-2.0
// Whole grids in the modes that follow surfaces.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/bake/placement/grid_support.h"

namespace tetralight {
namespace {

using test::add_box;
using test::error_of;
using test::Facing;
using test::grid_of;
using test::layers;
using test::positions_of;
using test::settings_for;

TEST(PlacementModes, LayersStandAboveTheFloor) {
    Scene scene;
    test::add_floor(scene, test::grey(), 4.0f);
    ProbeGridSettings settings = settings_for({{-4, 0, -4}, {4, 3, 4}}, 2.0);
    settings.mode = PlacementMode::Layers;
    settings.heights = {1.0, 2.0};
    const ProbeGrid grid = grid_of(scene, settings);
    EXPECT_EQ(grid.probe_count(), 32u);
    EXPECT_EQ(layers(grid, 1), (std::vector<double>{1.0, 2.0}));
    for (const int axis : {0, 2}) {
        EXPECT_EQ(layers(grid, axis), (std::vector<double>{-4.0, -1.0, 1.0, 4.0}));
    }
    EXPECT_GE(grid.coverage.share(Cover::Covered), 0.99);  // between the heights
}

TEST(PlacementModes, LayersAreCountedByTheirColumns) {
    // 8 x 8 columns with one probe each, where a lattice would have 40 layers.
    Scene scene;
    test::add_floor(scene, test::grey(), 4.0f);
    ProbeGridSettings settings = settings_for({{-4, 0, -4}, {4, 40, 4}}, 1.0);
    settings.mode = PlacementMode::Layers;
    settings.heights = {1.0};
    settings.max_probes = 64;
    EXPECT_EQ(grid_of(scene, settings).probe_count(), 64u);
    settings.max_probes = 63;
    EXPECT_EQ(error_of(scene, settings), "a grid of 64 probes is more than the limit of 63");
}

TEST(PlacementModes, SurfacesOfAThinWallHaveProbesOnBothSides) {
    Scene scene;
    test::add_floor(scene, test::grey(), 9.0f);
    add_box(scene, test::grey(), Facing::Outward, {-0.02f, 0, -3}, {0.02f, 3, 3});
    ProbeGridSettings settings = settings_for({{-2, 0, -3}, {2, 3, 3}}, 1.0);
    settings.mode = PlacementMode::Surface;
    const ProbeGrid grid = grid_of(scene, settings);
    size_t left = 0, right = 0;
    for (const glm::dvec3& p : positions_of(grid)) {
        left += p.x < 0.0 && p.x > -0.2;
        right += p.x > 0.0 && p.x < 0.2;
        EXPECT_GT(p.y, 0.0);  // under the one-sided floor is inside: pushed up, beside others
    }
    EXPECT_GE(left, 12u);
    EXPECT_GE(right, 12u);
    EXPECT_GT(grid.count(Fate::Crowded), 0u);
}

TEST(PlacementModes, BoundsOfNamedNodes) {
    Scene scene;
    test::add_floor(scene, test::grey(), 9.0f).name = "ground";
    add_box(scene, test::grey(), Facing::Inward, {0, 0, 0}, {4, 4, 4}).name = "room";
    ProbeGridSettings settings;
    settings.bounds_of = {"room"};
    const ProbeGrid grid = grid_of(scene, settings);
    EXPECT_EQ(grid.candidate_count, 64u);
    settings.bounds_of = {"room", "attic"};
    EXPECT_EQ(error_of(scene, settings), "there is no node \"attic\"");
}

TEST(PlacementModes, BoundsOfANodeAreThoseOfAllBelowIt) {
    Scene scene;
    scene.nodes = {{.name = "house"}, {.name = "upstairs", .parent = 0}, {.name = "garden"}};
    test::add_floor(scene, test::grey(), 90.0f);
    const auto add_room = [&](uint32_t node, float low) {
        add_box(scene, test::grey(), Facing::Inward, {0, low, 0}, {4, low + 4, 4}).node = node;
    };
    add_room(0, 0.0f);
    add_room(1, 4.0f);
    ProbeGridSettings settings;
    settings.bounds_of = {"house"};
    EXPECT_EQ(grid_of(scene, settings).candidate_count, 4u * 8u * 4u);
    settings.bounds_of = {"garden"};
    EXPECT_EQ(error_of(scene, settings), "node \"garden\" has no mesh to take bounds from");
}

/// A room of 4 m with a box in it on a floor that goes on outside.
Scene furnished_room() {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, test::two_sided(), 20.0f);
    add_box(scene, test::grey(), Facing::Outward, {-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f});
    return scene;
}

TEST(PlacementModes, NoneLeavesTheGivenBox) {
    using enum PlacementMode;
    const WorldBox box{{-2, 0, -2}, {2, 1.5, 2}};
    for (const PlacementMode mode : {Regular, Layers, Surface, Adaptive}) {
        ProbeGridSettings settings = settings_for(box, 0.5);
        settings.mode = mode;
        settings.max_probes = mode == Adaptive ? 100 : 100'000;
        settings.heights = {0.3, 1.7};
        const ProbeGrid grid = grid_of(furnished_room(), settings);
        for (const glm::dvec3& p : positions_of(grid)) {
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(p[axis], box.min[axis] - 1e-5) << static_cast<int>(mode);
                EXPECT_LE(p[axis], box.max[axis] + 1e-5) << static_cast<int>(mode);
            }
        }
    }
}

TEST(PlacementModes, ASceneHasRoomForLayersAboveItsHighestFloor) {
    Scene scene;
    add_box(scene, test::grey(), Facing::Outward, {-4, 0, -4}, {4, 3, 4});
    ProbeGridSettings settings;
    settings.spacing = glm::dvec3(2.0);
    settings.mode = PlacementMode::Layers;
    settings.heights = {1.0};
    EXPECT_EQ(layers(grid_of(scene, settings), 1), (std::vector<double>{4.0}));
}

TEST(PlacementModes, HeightsThatAreNearlyEqualCountOnce) {
    Scene scene;
    test::add_floor(scene, test::grey(), 4.0f);
    ProbeGridSettings settings = settings_for({{-4, 0, -4}, {4, 3, 4}}, 2.0);
    settings.mode = PlacementMode::Layers;
    settings.clearance = 0.1;
    settings.heights = {1.0, 1.0, 2.0, 1.05, 1.5};
    EXPECT_EQ(layers(grid_of(scene, settings), 1), (std::vector<double>{1.0, 1.5, 2.0}));
}

TEST(PlacementModes, DistancesBelongToTheProbes) {
    Scene scene;
    test::add_floor(scene, test::grey(), 50.0f);
    ProbeGridSettings settings = settings_for({{-4, 0, -4}, {4, 4, 4}}, 2.0);
    settings.region_size = 5.0;
    const ProbeGrid grid = grid_of(scene, settings);
    EXPECT_EQ(grid.groups.size(), 4u);
    const auto positions = positions_of(grid);
    ASSERT_EQ(grid.surface_distances.size(), positions.size());
    for (size_t i = 0; i < positions.size(); ++i) {
        EXPECT_NEAR(grid.surface_distances[i], positions[i].y, 1e-5);
    }
}

TEST(PlacementModes, AClearanceIsALength) {
    ProbeGridSettings settings = settings_for({{0, 0, 0}, {2, 2, 2}}, 1.0);
    settings.clearance = -0.5;
    EXPECT_EQ(error_of(Scene{}, settings), "clearance -0.5 is not a length");
}

}  // namespace
}  // namespace tetralight
