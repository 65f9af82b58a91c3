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

/// Rooms of a house along x and z, and its storeys; metres from the middle of a wall to the next.
inline constexpr int kHouseX = 3, kHouseZ = 2, kHouseY = 2;
inline constexpr float kHouseRoom = 4.0f, kHouseStorey = 3.0f, kHouseWall = 0.2f;

/// A wall of one room, along `axis` (0 or 2), with a door or a window in its middle.
inline void add_house_wall(Scene& scene, int axis, glm::vec3 corner, bool has_window) {
    const float half = has_window ? 0.8f : 0.45f, sill = has_window ? 0.9f : 0.0f;
    constexpr float kMiddle = 0.5f * kHouseRoom, kLintel = 2.1f;
    const auto part = [&](float from, float to, float low, float high) {
        glm::vec3 a = corner + glm::vec3(0, low, 0), b = corner + glm::vec3(0, high, 0);
        a[axis] += from;
        b[axis] += to;
        a[2 - axis] -= 0.5f * kHouseWall;
        b[2 - axis] += 0.5f * kHouseWall;
        add_solid(scene, a, b);
    };
    part(-0.5f * kHouseWall, kMiddle - half, 0, kHouseStorey);
    part(kMiddle + half, kHouseRoom + 0.5f * kHouseWall, 0, kHouseStorey);
    part(kMiddle - half, kMiddle + half, kLintel, kHouseStorey);
    if (sill > 0.0f) part(kMiddle - half, kMiddle + half, 0, sill);
}

/// A house with a door in each inner wall, a window in each outer one, a table in each room, and a
/// stairwell of 1.2 × 2.4 m in the first room. Floors are at y = 0 and 3, ceilings at 2.8 and 6.
inline Scene house() {
    Scene scene;
    const float wide = kHouseX * kHouseRoom, deep = kHouseZ * kHouseRoom;
    const float top = kHouseY * kHouseStorey;
    add_solid(scene, {-3, -0.2f, -3}, {wide + 3, 0, deep + 3});
    add_solid(scene, {-0.3f, top, -0.3f}, {wide + 0.3f, top + 0.2f, deep + 0.3f});
    add_solid(scene, {1.5f, 2.8f, -0.1f}, {wide + 0.1f, 3, deep + 0.1f});
    add_solid(scene, {-0.1f, 2.8f, 2.9f}, {1.5f, 3, deep + 0.1f});
    add_solid(scene, {-0.1f, 2.8f, -0.1f}, {1.5f, 3, 0.5f});
    add_solid(scene, {-0.1f, 2.8f, 0.5f}, {0.3f, 3, 2.9f});
    for (int y = 0; y < kHouseY; ++y) {
        const auto corner = [y](int x, int z) {
            return glm::vec3(x, 0, z) * kHouseRoom + glm::vec3(0, y, 0) * kHouseStorey;
        };
        for (int x = 0; x <= kHouseX; ++x) {
            for (int z = 0; z < kHouseZ; ++z)
                add_house_wall(scene, 2, corner(x, z), x % kHouseX == 0);
        }
        for (int z = 0; z <= kHouseZ; ++z) {
            for (int x = 0; x < kHouseX; ++x)
                add_house_wall(scene, 0, corner(x, z), z % kHouseZ == 0);
        }
        for (int i = 0; i < kHouseX * kHouseZ; ++i) {
            const glm::vec3 table = corner(i / kHouseZ, i % kHouseZ) + glm::vec3(2.3f, 0, 2.3f);
            add_solid(scene, table, table + glm::vec3(1.2f, 0.75f, 0.7f));
        }
    }
    return scene;
}

inline TraceScene traced(const Scene& scene) {
    auto made = TraceScene::make_static(scene);
    EXPECT_TRUE(made) << error_text(made.error());
    return std::move(*made);
}

}  // namespace tetralight::test
