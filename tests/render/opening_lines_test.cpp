// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/opening_lines.h>

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tests/support/window_room.h"

namespace tetralight {
namespace {

TEST(OpeningLines, AreTheWindowAndANetOverItsSpot) {
    // The sun falls 1 m for each metre along z: the window, 1 to 2 m above the floor at z = −2,
    // lights z = −1 to 0 on the floor.
    Scene scene = test::window_room();
    test::add_sun(scene, LightMode::Mixed, glm::vec3(1.0f)).direction =
        glm::normalize(glm::vec3(0, -1, 1));
    scene.portals = {{"window", {0, 1.5, -2}, {1, 0, 0}, {0, 1, 0}}};
    const auto lines = make_opening_lines(scene);
    ASSERT_TRUE(lines);
    ASSERT_EQ(lines->size(), 2u);
    ASSERT_EQ((*lines)[0].lines.size(), 4u);
    for (const auto& [from, to] : (*lines)[0].lines) {
        EXPECT_NEAR(glm::distance(from, to), 1.0, 1e-6);
        EXPECT_NEAR(from.z, -2.0, 1e-6);
    }
    ASSERT_EQ((*lines)[1].lines.size(), 2u * 24 * 23);
    glm::dvec3 low(1e9), high(-1e9);
    for (const auto& [from, to] : (*lines)[1].lines) {
        EXPECT_NEAR(glm::distance(from, to), 1.0 / 24, 1e-4);
        low = glm::min(low, glm::min(from, to));
        high = glm::max(high, glm::max(from, to));
    }
    EXPECT_LT(glm::distance(low, glm::dvec3(-0.5, 0, -1)), 0.04);
    EXPECT_LT(glm::distance(high, glm::dvec3(0.5, 0, 0)), 0.04);
}

TEST(OpeningLines, WithoutOpeningsThereAreNone) {
    Scene scene;
    test::add_floor(scene, test::wall_material(), 2.0f);
    test::add_sun(scene, LightMode::Mixed, glm::vec3(1.0f));
    const auto lines = make_opening_lines(scene);
    ASSERT_TRUE(lines);
    for (const GizmoLines& group : *lines) EXPECT_TRUE(group.lines.empty());
}

}  // namespace
}  // namespace tetralight
