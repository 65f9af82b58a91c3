// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <tetralight/base/error_text.h>
#include <tetralight/lppv/lppv.h>
#include "tests/support/property_volume.h"
#include "tests/support/random_walls.h"

namespace tetralight::test {

/// Probes in and at the corners of the box [-4, 4]³, lit by `linear_light`: interpolation
/// reproduces it everywhere inside.
inline ProbeVolume make_cube_volume() {
    std::vector<glm::dvec3> positions = random_positions(60, 7, 4.0);
    for (int i = 0; i < 8; ++i) {
        positions.emplace_back((i & 1) != 0 ? 4 : -4, (i & 2) != 0 ? 4 : -4, (i & 4) != 0 ? 4 : -4);
    }
    return make_lit_volume(std::move(positions));
}

/// A grid in a cube about the origin, scaled and then turned.
inline LppvGrid grid_in_box(glm::uvec3 resolution, const glm::dvec3& scale, double degrees,
                            LppvPlacement placement = LppvPlacement::CellCorners) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, 3));
    const glm::dmat4 world_from_object =
        glm::scale(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis), scale);
    const LppvPart cube{world_from_object, glm::dvec3(-0.5), glm::dvec3(0.5)};
    LppvSettings settings;
    settings.resolution_mode = LppvResolution::Custom;
    settings.resolution = resolution;
    settings.placement = placement;
    auto grid = make_lppv_grid({world_from_object, std::span(&cube, 1)}, settings);
    EXPECT_TRUE(grid) << error_text(grid.error());
    return *grid;
}

/// Random light, random walls, and each probe on one of two rendering layers.
inline ProbeVolume make_walled_volume() {
    ProbeVolume volume = make_random_volume(random_positions(300, 3), 4);
    add_random_walls(volume, 5);
    for (uint32_t i = 0; i < volume.positions.size(); ++i) {
        volume.rendering_layers.push_back(i % 2 == 0 ? 0b01 : 0b10);
    }
    return volume;
}

}  // namespace tetralight::test
