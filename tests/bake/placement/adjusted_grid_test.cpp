// SPDX-License-Identifier: Apache-2.0
// What adjustment volumes change of a grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/bake/placement/grid_support.h"

namespace tetralight {
namespace {

using test::error_of;
using test::grid_of;
using test::positions_of;
using test::settings_for;

const WorldBox kEight{{-4, -4, -4}, {4, 4, 4}};

ProbeAdjustment box_volume(const char* name, glm::dvec3 center, double size) {
    ProbeAdjustment adjustment;
    adjustment.name = name;
    adjustment.world_from_volume =
        glm::scale(glm::translate(glm::dmat4(1.0), center), glm::dvec3(size));
    return adjustment;
}

size_t count_in(const ProbeGrid& grid, const ProbeAdjustment& volume) {
    const auto positions = positions_of(grid);
    return static_cast<size_t>(
        std::count_if(positions.begin(), positions.end(),
                      [&](const glm::dvec3& p) { return contains(volume, p); }));
}

TEST(AdjustedGrid, AVolumeForbidsProbes) {
    Scene scene;
    scene.probe_adjustments = {box_volume("none", {0, 0, 0}, 4.0)};
    scene.probe_adjustments[0].forbids_probes = true;
    const ProbeGrid grid = grid_of(scene, settings_for(kEight, 1.0));
    EXPECT_EQ(grid.count(Fate::Forbidden), 64u);
    EXPECT_EQ(grid.probe_count(), 512u - 64u);
    EXPECT_EQ(count_in(grid, scene.probe_adjustments[0]), 0u);
}

TEST(AdjustedGrid, TheSmallestVolumeWins) {
    Scene scene;
    scene.probe_adjustments = {box_volume("none", {0, 0, 0}, 4.0),
                               box_volume("some", {0, 0, 0}, 2.0)};
    scene.probe_adjustments[0].forbids_probes = true;
    scene.probe_adjustments[1].forbids_probes = false;
    const ProbeGrid grid = grid_of(scene, settings_for(kEight, 1.0));
    EXPECT_EQ(grid.count(Fate::Forbidden), 64u - 8u);
    std::swap(scene.probe_adjustments[0], scene.probe_adjustments[1]);
    EXPECT_EQ(grid_of(scene, settings_for(kEight, 1.0)).groups, grid.groups);
}

TEST(AdjustedGrid, AVolumeHasItsOwnSpacing) {
    Scene scene;
    scene.probe_adjustments = {box_volume("dense", {0, 0, 0}, 2.0)};
    scene.probe_adjustments[0].spacing = 0.25;
    const ProbeGrid grid = grid_of(scene, settings_for(kEight, 1.0));
    EXPECT_EQ(count_in(grid, scene.probe_adjustments[0]), 512u);
    EXPECT_EQ(grid.probe_count(), 512u - 8u + 512u);
}

TEST(AdjustedGrid, ASpheresSpacingHoldsInTheSphereOnly) {
    Scene scene;
    scene.probe_adjustments = {box_volume("dense", {0, 0, 0}, 2.0)};
    scene.probe_adjustments[0].shape = AdjustmentShape::Sphere;  // of radius 2
    scene.probe_adjustments[0].spacing = 0.25;
    const ProbeGrid grid = grid_of(scene, settings_for(kEight, 1.0));
    // 4/3 π 2³ m³ at 64 a cubic metre.
    EXPECT_NEAR(static_cast<double>(count_in(grid, scene.probe_adjustments[0])), 2145.0, 60.0);
}

TEST(AdjustedGrid, TheAdaptiveModeKeepsWhatAVolumeAsksFor) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    scene.probe_adjustments = {box_volume("dense", {0, 0, 0}, 2.0)};
    scene.probe_adjustments[0].spacing = 0.5;
    ProbeGridSettings settings = settings_for(kEight, 1.0);
    settings.mode = PlacementMode::Adaptive;
    settings.max_probes = 500;
    const ProbeGrid grid = grid_of(scene, settings);
    // The light is even: all others could go.
    EXPECT_EQ(count_in(grid, scene.probe_adjustments[0]), 64u);
    EXPECT_LT(grid.probe_count(), 64u + 40u);
}

TEST(AdjustedGrid, RefusesVolumesThatAreNone) {
    Scene scene;
    scene.probe_adjustments = {box_volume("flat", {0, 0, 0}, 2.0)};
    const auto error = [&] { return error_of(scene, settings_for(kEight, 1.0)); };
    EXPECT_EQ(error(),
              "adjustment volume \"flat\": it adjusts nothing (forbid, spacing, validity, "
              "intensity, rendering_layers)");
    scene.probe_adjustments[0].spacing = -1.0;
    EXPECT_EQ(error(), "adjustment volume \"flat\": spacing -1 is not a positive length");
    scene.probe_adjustments[0] = box_volume("flat", {0, 0, 0}, 0.0);
    EXPECT_EQ(error(), "adjustment volume \"flat\": it has no volume");
}

}  // namespace
}  // namespace tetralight
