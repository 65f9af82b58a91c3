// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/scene_bounds.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

bool is_static(const MeshInstance& instance) {
    return instance.contributes_gi;
}

/// A box from (0, 0, 0) to (1, 2, 3).
Scene one_box() {
    Scene scene;
    test::add_box(scene, Material{}, test::Facing::Outward, {0, 0, 0}, {1, 2, 3});
    return scene;
}

TEST(SceneBounds, AreThoseOfTheVerticesInTheWorld) {
    Scene scene = one_box();
    scene.instances[0].world_from_mesh =
        glm::scale(glm::translate(glm::dmat4(1.0), {10, 20, 30}), {-1, 2, 1});
    const WorldBox expected{{9, 20, 30}, {10, 24, 33}};
    EXPECT_EQ(instance_bounds(scene, scene.instances[0]), expected);
}

TEST(SceneBounds, KeepDoublePrecisionFarAway) {
    Scene scene = one_box();
    scene.instances[0].world_from_mesh = glm::translate(glm::dmat4(1.0), {1e9 + 0.125, 0, 0});
    EXPECT_EQ(world_position(scene.instances[0], {1, 2, 3}), glm::dvec3(1e9 + 1.125, 2, 3));
}

TEST(SceneBounds, HoldAllSelectedInstances) {
    Scene scene = one_box();
    test::add_floor(scene, Material{}, 5.0f, -1.0f);
    test::add_floor(scene, Material{}, 100.0f).contributes_gi = false;
    EXPECT_EQ(scene_bounds(scene, is_static), (WorldBox{{-5, -1, -5}, {5, 2, 5}}));
    EXPECT_EQ(scene_bounds(scene, [](const MeshInstance&) { return true; })->size().x, 200.0);
}

TEST(SceneBounds, OfNothingAreNone) {
    Scene scene = one_box();
    EXPECT_FALSE(scene_bounds(scene, [](const MeshInstance&) { return false; }));
    EXPECT_FALSE(scene_bounds(Scene{}, is_static));
    scene.meshes[0] = Mesh{};
    EXPECT_FALSE(instance_bounds(scene, scene.instances[0]));
    EXPECT_FALSE(scene_bounds(scene, is_static));
}

TEST(SceneMiddle, IsTheCenterOfTheBounds) {
    Scene scene = one_box();
    test::add_floor(scene, Material{}, 200.0f);
    test::add_floor(scene, Material{}, 1e9f).contributes_gi = false;
    EXPECT_EQ(scene_center(scene, is_static), glm::dvec3(0.0, 1.0, 0.0));
}

TEST(SceneMiddle, StaysWhereMostVerticesAre) {
    Scene scene = one_box();
    test::add_quad(scene, Material{}, {1e9f, 1e9f, 1e9f}, {1, 0, 0}, {0, 1, 0});
    EXPECT_LE(glm::length(scene_center(scene, is_static)), 4.0);
}

TEST(SceneMiddle, OfManyVerticesIsThatOfSome) {
    // More vertices than are asked; those of the second mesh are the majority.
    Scene scene = one_box();
    for (const double x : {0.0, 1e6}) {
        scene.meshes.push_back(scene.meshes[0]);
        const size_t count = x > 0.0 ? 300'001 : 60'000;
        scene.meshes.back().positions.assign(count, glm::vec3(0.25f));
        MeshInstance instance = scene.instances[0];
        instance.mesh = static_cast<uint32_t>(scene.meshes.size() - 1);
        instance.world_from_mesh = glm::translate(glm::dmat4(1.0), {x, 0, 0});
        scene.instances.push_back(instance);
    }
    EXPECT_EQ(scene_center(scene, is_static), glm::dvec3(1e6 + 0.25, 0.25, 0.25));
}

TEST(SceneMiddle, OfNothingIsTheOrigin) {
    EXPECT_EQ(scene_center(Scene{}, is_static), glm::dvec3(0.0));
}

TEST(SceneBounds, BoxHasACenterAndASize) {
    const WorldBox box{{-1, 0, 2}, {3, 4, 2}};
    EXPECT_EQ(box.center(), glm::dvec3(1, 2, 2));
    EXPECT_EQ(box.size(), glm::dvec3(4, 4, 0));
}

}  // namespace
}  // namespace tetralight
