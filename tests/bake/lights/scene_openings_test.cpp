// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/scene_openings.h>

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/window_room.h"

namespace tetralight {
namespace {

std::vector<Opening> openings_in(const Scene& scene) {
    return openings_of(scene, *TraceScene::make_static(scene));
}

Portal window_portal() {
    return {"window", {0, 1.5, -2}, {1, 0, 0}, {0, 1, 0}};
}

TEST(SceneOpenings, NeedLightThatCanEnter) {
    Scene scene = test::window_room();
    scene.portals = {window_portal()};
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(1.0f), {0, 1, 0});
    EXPECT_TRUE(openings_in(scene).empty());
    test::add_sun(scene, LightMode::Realtime, glm::vec3(1.0f));
    EXPECT_TRUE(openings_in(scene).empty());
    Scene sunny = scene, cloudy = scene;
    test::add_sun(sunny, LightMode::Mixed, glm::vec3(1.0f));
    EXPECT_EQ(openings_in(sunny).size(), 1u);
    cloudy.environment.radiance = glm::vec3(1.0f);
    EXPECT_EQ(openings_in(cloudy).size(), 1u);
}

TEST(SceneOpenings, PortalsPointToTheDarkSide) {
    Scene scene = test::window_room();
    scene.environment.radiance = glm::vec3(1.0f);
    for (const double sign : {1.0, -1.0}) {
        scene.portals = {window_portal()};
        scene.portals[0].across *= sign;
        const std::vector<Opening> openings = openings_in(scene);
        ASSERT_EQ(openings.size(), 1u) << "the window is not found again";
        EXPECT_EQ(openings[0].normal, glm::vec3(0, 0, 1));
        EXPECT_FLOAT_EQ(openings[0].area(), 1.0f);
    }
}

/// Around a position inside the room, facing the window.
Portal portal_at(const glm::dvec3& center, double width = 1.0) {
    return {"elsewhere", center, {width, 0, 0}, {0, width, 0}};
}

TEST(SceneOpenings, OtherWindowsAreFound) {
    Scene scene = test::window_room();
    scene.environment.radiance = glm::vec3(1.0f);
    scene.portals = {portal_at({0, 1.5, 0})};
    EXPECT_EQ(openings_in(scene).size(), 2u);
    // Much smaller or larger ones do not stand for the window.
    scene.portals = {portal_at({0, 1.5, -2}, 0.1), portal_at({0, 1.5, -2}, 3.0)};
    EXPECT_EQ(openings_in(scene).size(), 3u);
}

TEST(SceneOpenings, RectanglesInTheOpenAirAreLeftOut) {
    Scene scene = test::window_room();
    scene.environment.radiance = glm::vec3(1.0f);
    for (int i = 0; i < 40; ++i) scene.portals.push_back(portal_at({3.0 * i, 30, 0}));
    const std::vector<Opening> openings = openings_in(scene);
    ASSERT_EQ(openings.size(), 1u);
    EXPECT_NEAR(openings[0].area(), 1.0f, 0.2f);
}

TEST(SceneOpenings, ThoseThatLetInMostLightAreUsed) {
    Scene scene = test::window_room();
    scene.environment.radiance = glm::vec3(1.0f);
    for (int i = 0; i < 40; ++i) scene.portals.push_back(portal_at({0, 1.5, -2}, 0.3));
    const std::vector<Opening> openings = openings_in(scene);
    ASSERT_EQ(openings.size(), Openings::kMaxCount);
    EXPECT_NEAR(openings[0].area(), 1.0f, 0.2f) << "the window was found last";
}

}  // namespace
}  // namespace tetralight
