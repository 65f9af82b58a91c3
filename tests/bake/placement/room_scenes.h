// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/base/error_text.h>
#include "tests/support/scenes.h"

// Buildings for tests: walls are solid boxes, 20 cm thick, with rooms between them.

namespace tetralight::test {

inline void add_solid(Scene& scene, glm::vec3 low, glm::vec3 high) {
    add_box(scene, diffuse(glm::vec3(0.5f)), Facing::Outward, low, high);
}

/// Floor, ceiling and four walls around a room.
inline void add_room(Scene& scene, glm::vec3 low, glm::vec3 high) {
    constexpr float kWall = 0.2f;
    const glm::vec3 a = low - kWall, b = high + kWall;
    add_solid(scene, a, {b.x, low.y, b.z});
    add_solid(scene, {a.x, high.y, a.z}, b);
    add_solid(scene, {a.x, low.y, a.z}, {low.x, high.y, b.z});
    add_solid(scene, {high.x, low.y, a.z}, {b.x, high.y, b.z});
    add_solid(scene, {low.x, low.y, a.z}, {high.x, high.y, low.z});
    add_solid(scene, {low.x, low.y, high.z}, {high.x, high.y, b.z});
}

/// A room of 8.2 × 2.5 × 4 m that a wall parts at x = 4 to 4.2, with an opening in its middle.
inline Scene two_rooms(float opening_width, float opening_height) {
    Scene scene;
    add_room(scene, {0, 0, 0}, {8.2f, 2.5f, 4});
    const float low = 2.0f - 0.5f * opening_width, high = 2.0f + 0.5f * opening_width;
    add_solid(scene, {4, 0, 0}, {4.2f, 2.5f, low});
    add_solid(scene, {4, 0, high}, {4.2f, 2.5f, 4});
    if (opening_height < 2.5f) add_solid(scene, {4, opening_height, low}, {4.2f, 2.5f, high});
    return scene;
}

inline TraceScene traced(const Scene& scene) {
    auto made = TraceScene::make_static(scene);
    EXPECT_TRUE(made) << error_text(made.error());
    return std::move(*made);
}

}  // namespace tetralight::test
