// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tests/support/scenes.h"

namespace tetralight::test {

/// Two rooms of 4 × 3 × 4 m beside each other, x < 0 with a lamp in its ceiling, the other dark;
/// between them a wall, or a surface without thickness.
inline Scene two_rooms(float thickness) {
    Scene scene;
    Material grey = diffuse(glm::vec3(0.7f));
    const float half = 0.5f * thickness;
    if (thickness > 0.0f) {
        add_box(scene, grey, Facing::Inward, {-4 - half, 0, 0}, {-half, 3, 4});
        add_box(scene, grey, Facing::Inward, {half, 0, 0}, {4 + half, 3, 4});
    } else {
        add_box(scene, grey, Facing::Inward, {-4, 0, 0}, {4, 3, 4});
        grey.is_double_sided = true;
        add_quad(scene, grey, {0, 0, 0}, {0, 3, 0}, {0, 0, 4});
    }
    const Material lamp = diffuse(glm::vec3(0.0f), glm::vec3(10.0f));
    add_quad(scene, lamp, {-2.5f - half, 2.99f, 1.5f}, {1, 0, 0}, {0, 0, 1});
    return scene;
}

/// A lattice half a spacing from the walls of both rooms.
inline std::vector<glm::dvec3> in_rooms(double thickness, double spacing) {
    std::vector<glm::dvec3> positions;
    for (double x = 0.5 * spacing; x < 4.0; x += spacing) {
        for (double y = 0.5 * spacing; y < 3.0; y += spacing) {
            for (double z = 0.5 * spacing; z < 4.0; z += spacing) {
                positions.emplace_back(x + 0.5 * thickness, y, z);
                positions.emplace_back(-x - 0.5 * thickness, y, z);
            }
        }
    }
    return positions;
}

/// Closed rooms of 2 × 2 × 2 m in a row along x, 0.2 m apart; the first begins at x = 0. The walls
/// of room i emit `radiance[i]` and reflect nothing, so that this is the light everywhere in it.
inline Scene row_of_rooms(const std::vector<float>& radiance) {
    Scene scene;
    for (size_t i = 0; i < radiance.size(); ++i) {
        const float x = 2.2f * static_cast<float>(i);
        add_box(scene, diffuse(glm::vec3(0.0f), glm::vec3(radiance[i])), Facing::Inward, {x, 0, 0},
                {x + 2, 2, 2});
    }
    return scene;
}

/// Adds a lattice of n × n × n probes to room i of such a row; the outer ones are `margin` off the
/// walls.
inline void add_probes_of_room(size_t i, int n, double margin, std::vector<glm::dvec3>& positions) {
    const auto coordinate = [&](int k) { return margin + (2.0 - 2.0 * margin) * k / (n - 1); };
    for (int x = 0; x < n; ++x) {
        for (int y = 0; y < n; ++y) {
            for (int z = 0; z < n; ++z) {
                positions.emplace_back(2.2 * static_cast<double>(i) + coordinate(x), coordinate(y),
                                       coordinate(z));
            }
        }
    }
}

}  // namespace tetralight::test
