// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/scenes.h"

// A room whose light comes through one window.

namespace tetralight::test {

inline Material wall_material(glm::vec3 albedo = glm::vec3(0.6f),
                              glm::vec3 emission = glm::vec3(0.0f)) {
    Material material = diffuse(albedo, emission);
    material.is_double_sided = true;
    return material;
}

/// Corner of the window of `window_room`, and its edges.
inline constexpr glm::vec3 kWindow(-0.5f, 1.0f, -2.0f), kWindowAlong(1, 0, 0), kUp(0, 1, 0);

/// A room of 4 × 3 × 4 m around the Y axis, without the wall at z = −2. The floor is its first
/// instance.
inline Scene room_with_an_open_side(const Material& walls = wall_material()) {
    Scene scene;
    add_floor(scene, walls, 2.0f);
    add_ceiling(scene, walls, 2.0f, 3.0f);
    add_quad(scene, walls, {-2, 0, 2}, {0, 3, 0}, {4, 0, 0});
    add_quad(scene, walls, {-2, 0, -2}, {0, 3, 0}, {0, 0, 4});
    add_quad(scene, walls, {2, 0, -2}, {0, 0, 4}, {0, 3, 0});
    return scene;
}

/// The same with a wall there, which has a window of 1 m².
inline Scene window_room(const Material& walls = wall_material()) {
    Scene scene = room_with_an_open_side(walls);
    add_quad(scene, walls, {-2, 0, -2}, {1.5f, 0, 0}, {0, 3, 0});
    add_quad(scene, walls, {0.5f, 0, -2}, {1.5f, 0, 0}, {0, 3, 0});
    add_quad(scene, walls, {-0.5f, 0, -2}, {1, 0, 0}, {0, 1, 0});
    add_quad(scene, walls, {-0.5f, 2, -2}, {1, 0, 0}, {0, 1, 0});
    return scene;
}

}  // namespace tetralight::test
