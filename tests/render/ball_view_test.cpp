// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/ball_view.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

glm::dvec3 eye_of(const Camera& camera) {
    return glm::dvec3(camera.world_from_camera[3]);
}

/// A room around the origin without a way out.
Scene room(const glm::vec3& half_size) {
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Inward, -half_size,
                  half_size);
    return scene;
}

SceneShader shader_of(const Scene& scene) {
    return *SceneShader::make(scene, ProbeVolumeView{});
}

TEST(BallView, LooksFromTheFrontWhenNothingIsInTheWay) {
    const auto camera = find_ball_camera(nullptr, {1, 2, 3}, 2.0);
    ASSERT_TRUE(camera);
    EXPECT_NEAR(glm::distance(eye_of(*camera), glm::dvec3(1, 2, 3)), 6.4, 1e-9);
    EXPECT_GT(eye_of(*camera).z, 8.0);
}

TEST(BallView, FieldOfViewHoldsTheBallFromEveryStand) {
    for (const float half_size : {20.0f, 5.0f, 3.2f}) {  // leaves room for one stand after another
        const Scene scene = room(glm::vec3(half_size));
        const SceneShader shader = shader_of(scene);
        const auto camera = find_ball_camera(&shader, glm::dvec3(0.0), 2.0);
        ASSERT_TRUE(camera) << half_size;
        const double angle = std::asin(2.0 / glm::length(eye_of(*camera)));
        EXPECT_LT(angle, 0.5 * camera->fov_y_radians) << half_size;
        for (int i = 0; i < 3; ++i) EXPECT_LT(std::abs(eye_of(*camera)[i]), half_size);
    }
}

TEST(BallView, StaysInARoomThatIsLong) {
    const Scene scene = room({20, 2, 2});
    const SceneShader shader = shader_of(scene);
    const auto camera = find_ball_camera(&shader, glm::dvec3(0.0), 1.5);
    ASSERT_TRUE(camera);
    EXPECT_LT(std::abs(eye_of(*camera).z), 2.0);
    EXPECT_LT(std::abs(eye_of(*camera).y), 2.0);
}

TEST(BallView, MakesTheBallSmallerWhereThereIsNoRoom) {
    const Scene scene = room(glm::vec3(2.0f));
    const SceneShader shader = shader_of(scene);
    const glm::dvec3 center(0.0);
    const double radii[] = {4.0, 1.0};
    const BallView view = find_ball_view(&shader, {&center, 1}, radii);
    EXPECT_EQ(view.radius, 1.0);
    EXPECT_LT(glm::length(eye_of(view.camera)), 2.0 * std::sqrt(3.0));
}

TEST(BallView, TakesAnotherCenterWhenTheFirstIsBuried) {
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward, glm::vec3(-1.0f),
                  glm::vec3(1.0f));
    const SceneShader shader = shader_of(scene);
    const glm::dvec3 centers[] = {glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 8.0)};
    const double radius = 1.0;
    EXPECT_EQ(find_ball_view(&shader, centers, {&radius, 1}).center, centers[1]);
}

TEST(BallView, KeepsTheBallOutOfAFloorThatItCouldBeSeenOver) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 1.0f, -0.8f);
    const SceneShader shader = shader_of(scene);
    EXPECT_FALSE(is_open(shader, glm::dvec3(0.0), 1.0));
    EXPECT_TRUE(is_open(shader, glm::dvec3(0.0), 0.7));
    const glm::dvec3 center(0.0);
    const double radii[] = {1.0, 0.5};
    EXPECT_EQ(find_ball_view(&shader, {&center, 1}, radii).radius, 0.5);
}

}  // namespace
}  // namespace tetralight
