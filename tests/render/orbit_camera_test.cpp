// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/orbit_camera.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/render/image_renderer.h>

namespace tetralight {
namespace {

const glm::dvec3 kTarget(1, 2, 3);

glm::dvec3 eye(const OrbitCamera& orbit) {
    return glm::dvec3(orbit.camera().world_from_camera[3]);
}

TEST(OrbitCamera, BeginsWhereTheCameraStands) {
    const glm::dvec3 start(4, 5, -6);
    const OrbitCamera orbit(look_at(start, kTarget, 0.7), kTarget);
    EXPECT_NEAR(glm::distance(eye(orbit), start), 0.0, 1e-9);
    EXPECT_EQ(orbit.camera().fov_y_radians, 0.7);
    const glm::dvec3 ahead = -glm::dvec3(orbit.camera().world_from_camera[2]);
    EXPECT_NEAR(glm::dot(ahead, glm::normalize(kTarget - start)), 1.0, 1e-9);
}

TEST(OrbitCamera, TurnsAtTheSameDistance) {
    OrbitCamera orbit(look_at(kTarget + glm::dvec3(0, 0, 5), kTarget, 0.7), kTarget);
    orbit.turn(std::numbers::pi / 2, 0.0);
    EXPECT_NEAR(glm::distance(eye(orbit), kTarget + glm::dvec3(5, 0, 0)), 0.0, 1e-9);
    orbit.zoom(2.0);
    EXPECT_NEAR(glm::distance(eye(orbit), kTarget + glm::dvec3(10, 0, 0)), 0.0, 1e-9);
}

TEST(OrbitCamera, ZoomsWhatAnOrthographicCameraShows) {
    Camera start = look_at(kTarget + glm::dvec3(0, 0, 5), kTarget, 0.7);
    EXPECT_EQ(OrbitCamera(start, kTarget).camera().half_height, std::nullopt);
    start.half_height = 3.0;
    OrbitCamera orbit(start, kTarget);
    orbit.zoom(2.0);
    EXPECT_EQ(orbit.camera().half_height, 6.0);
}

TEST(OrbitCamera, StopsShortOfThePoles) {
    OrbitCamera orbit(look_at(kTarget + glm::dvec3(0, 5, 0), kTarget, 0.7), kTarget);
    for (const double pitch : {9.0, -99.0}) {
        orbit.turn(0.3, pitch);
        const glm::dvec3 offset = eye(orbit) - kTarget;
        EXPECT_NEAR(glm::length(offset), 5.0, 1e-9);
        EXPECT_GT(glm::length(glm::dvec2(offset.x, offset.z)), 0.1);
        EXPECT_GT(offset.y * pitch, 0.0);
    }
}

}  // namespace
}  // namespace tetralight
