// SPDX-License-Identifier: Apache-2.0
// Scenes whose free space every mode has to cover.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "tests/bake/placement/grid_support.h"

namespace tetralight {
namespace {

using test::add_box;
using test::Facing;
using test::grid_of;
using test::positions_of;
using test::settings_for;

constexpr PlacementMode kModes[] = {PlacementMode::Regular, PlacementMode::Layers,
                                    PlacementMode::Surface, PlacementMode::Adaptive};

/// The least share of free space that is covered.
constexpr double kLeast = 0.97;

double covered(const ProbeGrid& grid) {
    return grid.coverage.share(Cover::Covered);
}

ProbeGridSettings settings_of(PlacementMode mode, double spacing) {
    ProbeGridSettings settings;
    settings.mode = mode;
    settings.spacing = glm::dvec3(spacing);
    if (mode == PlacementMode::Adaptive) settings.max_probes = 200;
    settings.adaptive.bake.bounces = 1;
    return settings;
}

/// A room of 4 × 3 × 4 m with a lamp and a box in it.
Scene box_room() {
    Scene scene;
    add_box(scene, test::grey(), Facing::Inward, {0, 0, 0}, {4, 3, 4});
    add_box(scene, test::grey(), Facing::Outward, {1, -0.1f, 1}, {2, 0.9f, 2});
    test::add_point_light(scene, LightMode::Baked, glm::vec3(10.0f), {3, 2.5f, 3});
    return scene;
}

/// Two rooms of 4 × 3 × 4 m; the wall between them has a door of 0.9 × 2 m.
Scene rooms_with_door() {
    Scene scene;
    add_box(scene, test::grey(), Facing::Inward, {-4, 0, 0}, {4, 3, 4});
    const auto wall = [&](glm::vec3 low, glm::vec3 high) {
        add_box(scene, test::grey(), Facing::Outward, low, high);
    };
    wall({-0.1f, -0.1f, -0.1f}, {0.1f, 3.1f, 1.5f});
    wall({-0.1f, -0.1f, 2.4f}, {0.1f, 3.1f, 4.1f});
    wall({-0.1f, 2.0f, 1.5f}, {0.1f, 3.1f, 2.4f});
    test::add_point_light(scene, LightMode::Baked, glm::vec3(10.0f), {-3, 2.5f, 3});
    return scene;
}

TEST(MustHold, EveryModeCoversARoom) {
    for (const PlacementMode mode : kModes) {
        const ProbeGrid grid = grid_of(box_room(), settings_of(mode, 1.0));
        EXPECT_GE(covered(grid), kLeast) << static_cast<int>(mode);
        EXPECT_LE(grid.probe_count(), 400u) << static_cast<int>(mode);
        for (const float distance : grid.surface_distances) EXPECT_GE(distance, 0.049f);
    }
}

TEST(MustHold, EveryModeCoversTwoRoomsWithADoor) {
    for (const PlacementMode mode : kModes) {
        const ProbeGrid grid = grid_of(rooms_with_door(), settings_of(mode, 1.0));
        EXPECT_GE(covered(grid), kLeast) << static_cast<int>(mode);
        EXPECT_EQ(grid.groups.size(), 1u) << static_cast<int>(mode);
        EXPECT_EQ(grid.count(Fate::Unreachable), 0u) << static_cast<int>(mode);
    }
}

/// A hill of one layer, 2 m high, under a white sky.
double height_of_hill(double x, double z) {
    return 1.0 + std::cos(0.3 * x) * std::cos(0.3 * z);
}

Scene terrain() {
    constexpr int kSize = 40;
    Mesh mesh;
    for (int z = 0; z <= kSize; ++z) {
        for (int x = 0; x <= kSize; ++x) {
            const double wx = 0.5 * x - 10.0, wz = 0.5 * z - 10.0;
            mesh.positions.emplace_back(wx, height_of_hill(wx, wz), wz);
            mesh.normals.emplace_back(0, 1, 0);
        }
    }
    for (uint32_t z = 0; z < kSize; ++z) {
        for (uint32_t x = 0; x < kSize; ++x) {
            const uint32_t i = z * (kSize + 1) + x, down = i + kSize + 1;
            for (const uint32_t k : {i, down, down + 1, i, down + 1, i + 1})
                mesh.indices.push_back(k);
        }
    }
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_mesh(scene, test::grey(), std::move(mesh));
    return scene;
}

TEST(MustHold, TerrainOfOneLayerIsCoveredAndNothingIsUnderIt) {
    for (const PlacementMode mode : {PlacementMode::Regular, PlacementMode::Layers}) {
        const ProbeGrid grid = grid_of(terrain(), settings_of(mode, 2.0));
        EXPECT_GE(covered(grid), kLeast) << static_cast<int>(mode);
        EXPECT_EQ(grid.spaces.at(0).fate, SpaceFate::Filled);
        EXPECT_TRUE(grid.spaces[0].light.has_sky);
        for (const glm::dvec3& p : positions_of(grid)) {
            // Under its edges, the sky is seen past it.
            const bool is_at_edge = std::max(std::abs(p.x), std::abs(p.z)) > 9.7;
            EXPECT_TRUE(is_at_edge || p.y > height_of_hill(p.x, p.z)) << p.x << " " << p.z;
        }
    }
}

TEST(MustHold, AShipAtSeaNeedsNoEnclosure) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, test::grey(), 20.0f);
    add_box(scene, test::grey(), Facing::Outward, {-6, -1, -2}, {6, 2, 2});
    add_box(scene, test::grey(), Facing::Outward, {-2, 1, -1}, {2, 4, 1});
    for (const PlacementMode mode : {PlacementMode::Regular, PlacementMode::Adaptive}) {
        ProbeGridSettings settings = settings_of(mode, 2.0);
        settings.bounds = WorldBox{{-10, 0, -6}, {10, 8, 6}};
        const ProbeGrid grid = grid_of(scene, settings);
        EXPECT_GE(covered(grid), kLeast) << static_cast<int>(mode);
        EXPECT_EQ(grid.groups.size(), 1u) << static_cast<int>(mode);
        for (const glm::dvec3& p : positions_of(grid)) {
            const bool is_in_hull = std::abs(p.x) < 6 && p.y < 2 && std::abs(p.z) < 2;
            EXPECT_FALSE(is_in_hull) << p.x << " " << p.y << " " << p.z;
        }
    }
}

/// Two storeys of 4 × 2.5 × 4 m with a slab of 0.5 m between them that has a shaft.
Scene storeys(float shaft) {
    Scene scene;
    add_box(scene, test::grey(), Facing::Inward, {0, 0, 0}, {4, 5.5f, 4});
    const auto slab = [&](float x, float z, float to_x, float to_z) {
        add_box(scene, test::grey(), Facing::Outward, {x, 2.5f, z}, {to_x, 3, to_z});
    };
    slab(-0.1f, -0.1f, 1.2f, 4.1f);
    slab(1.2f + shaft, -0.1f, 4.1f, 4.1f);
    slab(1.2f, -0.1f, 1.2f + shaft, 1.2f);
    slab(1.2f, 1.2f + shaft, 1.2f + shaft, 4.1f);
    test::add_point_light(scene, LightMode::Baked, glm::vec3(10.0f), {3, 2, 3});
    test::add_point_light(scene, LightMode::Baked, glm::vec3(10.0f), {3, 5, 3});
    return scene;
}

TEST(MustHold, AShaftJoinsStoreysIfABodyPasses) {
    const ProbeGridSettings settings = settings_for({{0, 0, 0}, {4, 5.5, 4}}, 1.0);
    const ProbeGrid grid = grid_of(storeys(1.0f), settings);
    EXPECT_EQ(grid.groups.size(), 1u);
    EXPECT_EQ(grid.spaces.size(), 1u);
    EXPECT_GE(covered(grid), kLeast);
    // A hole of 10 cm is for no body of radius 10 cm.
    const ProbeGrid apart = grid_of(storeys(0.1f), settings);
    ASSERT_EQ(apart.spaces.size(), 2u);
    EXPECT_EQ(apart.spaces[1].fate, SpaceFate::Unreachable);
    const bool is_low = positions_of(apart).front().y < 2.5;
    for (const glm::dvec3& p : positions_of(apart)) EXPECT_EQ(p.y < 2.5, is_low);
}

TEST(MustHold, ASkyboxMeshChangesNothing) {
    Scene scene = box_room();
    ProbeGridSettings settings = settings_for({{0, 0, 0}, {4, 3, 4}}, 1.0);
    const ProbeGrid grid = grid_of(scene, settings);
    add_box(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(1.0f)), Facing::Inward, glm::vec3(-500),
            glm::vec3(500));
    const ProbeGrid other = grid_of(scene, settings);
    // Positions are rounded otherwise.
    const auto positions = positions_of(grid), others = positions_of(other);
    ASSERT_EQ(others.size(), positions.size());
    for (size_t i = 0; i < positions.size(); ++i) {
        EXPECT_LT(glm::distance(others[i], positions[i]), 1e-5);
    }
    EXPECT_EQ(other.fate_counts, grid.fate_counts);
    EXPECT_EQ(other.spaces.size(), grid.spaces.size());
}

TEST(MustHold, OrderOfMeshesAndThreadsDoNotMatter) {
    for (const PlacementMode mode : {PlacementMode::Layers, PlacementMode::Surface}) {
        Scene scene = rooms_with_door();
        ProbeGridSettings settings = settings_of(mode, 1.0);
        settings.thread_count = 1;
        const ProbeGrid one = grid_of(scene, settings);
        std::swap(scene.instances[0], scene.instances[3]);
        settings.thread_count = 2;
        const ProbeGrid two = grid_of(scene, settings);
        EXPECT_EQ(two.groups, one.groups) << static_cast<int>(mode);
        EXPECT_EQ(two.spaces, one.spaces) << static_cast<int>(mode);
        EXPECT_EQ(two.uncovered, one.uncovered) << static_cast<int>(mode);
    }
}

}  // namespace
}  // namespace tetralight
