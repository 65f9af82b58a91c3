// SPDX-License-Identifier: Apache-2.0
#include "bake/scene/scene_bounds.h"

#include <gtest/gtest.h>

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
    const Box expected{{9, 20, 30}, {10, 24, 33}};
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
    EXPECT_EQ(scene_bounds(scene, is_static), (Box{{-5, -1, -5}, {5, 2, 5}}));
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

TEST(SceneBounds, BoxHasACenterAndASize) {
    const Box box{{-1, 0, 2}, {3, 4, 2}};
    EXPECT_EQ(box.center(), glm::dvec3(1, 2, 2));
    EXPECT_EQ(box.size(), glm::dvec3(4, 4, 0));
}

}  // namespace
}  // namespace tetralight
