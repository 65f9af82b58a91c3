// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/sampled_grid.h>

#include <gtest/gtest.h>

#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

std::vector<glm::dvec3> box_corners(const glm::dvec3& low, const glm::dvec3& high) {
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 8; ++i) {
        corners.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                             i & 4 ? high.z : low.z);
    }
    return corners;
}

void expect_near(const IrradianceSh& a, const IrradianceSh& b, float tolerance) {
    for (int i = 0; i < kShCoefficientCount; ++i) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(a.coefficients[i][c], b.coefficients[i][c], tolerance) << i << ", " << c;
        }
    }
}

/// Light that is linear in the position is linear in a grid too.
TEST(SampledGrid, HoldsLinearLight) {
    const ProbeVolume volume = test::make_lit_volume(box_corners({-1, 0, 2}, {3, 2, 8}));
    const auto grid = sample_grid(volume.view(), {.resolution = {4, 2, 3}});
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->bounds.min, glm::dvec3(-1, 0, 2));
    EXPECT_EQ(grid->bounds.max, glm::dvec3(3, 2, 8));
    EXPECT_EQ(grid->center(0, 0, 0), glm::dvec3(-0.5, 0.5, 3));
    EXPECT_EQ(grid->center(3, 1, 2), glm::dvec3(2.5, 1.5, 7));
    expect_near(grid->at(3, 1, 2), test::linear_light({2.5, 1.5, 7}), 1e-4f);
    expect_near(grid->sample({0.1, 0.9, 5.5}), test::linear_light({0.1, 0.9, 5.5}), 1e-4f);
    // Beyond the outermost centers it is constant.
    expect_near(grid->sample({9, 9, 9}), test::linear_light({2.5, 1.5, 7}), 1e-4f);
}

TEST(SampledGrid, HasCellsUpToTheSpacing) {
    const ProbeVolume volume = test::make_lit_volume(box_corners({0, 0, 0}, {4, 2, 1}));
    EXPECT_EQ(sample_grid(volume.view(), {.spacing = 0.5})->resolution, glm::uvec3(8, 4, 2));
    EXPECT_EQ(sample_grid(volume.view(), {.spacing = 0.6})->resolution, glm::uvec3(7, 4, 2));
    EXPECT_EQ(sample_grid(volume.view(), {.spacing = 100})->resolution, glm::uvec3(1, 1, 1));
    // Eight probes in 8 m³: 1 m.
    EXPECT_EQ(sample_grid(volume.view(), {})->resolution, glm::uvec3(4, 2, 1));
}

TEST(SampledGrid, OfAPlaneHasAThickness) {
    const ProbeVolume volume = test::make_lit_volume({{0, 1, 0}, {1, 1, 0}, {0, 1, 1}, {1, 1, 1}});
    const auto grid = sample_grid(volume.view(), {.resolution = {2, 1, 2}});
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->bounds.min.y, 0.5);
    EXPECT_EQ(grid->bounds.max.y, 1.5);
}

TEST(SampledGrid, RefusesWhatIsNotAGrid) {
    const ProbeVolume volume = test::make_lit_volume(box_corners({0, 0, 0}, {1, 1, 1}));
    const auto field = [&](const ExportSettings& settings) {
        const auto grid = sample_grid(volume.view(), settings);
        return grid ? "" : grid.error().field;
    };
    EXPECT_EQ(field({.bounds = Box<glm::dvec3>{{0, 0, 0}, {1, 0, 1}}}), "bounds");
    EXPECT_EQ(field({.bounds = Box<glm::dvec3>{{0, 2, 0}, {1, 1, 1}}}), "bounds");
    EXPECT_EQ(field({.resolution = {2049, 1, 1}}), "resolution");
    EXPECT_EQ(field({.resolution = {2048, 2048, 2}}), "resolution");
    EXPECT_EQ(field({.spacing = 1e-9}), "spacing");
}

TEST(SampledGrid, DiffersLittleIfLightIsLinear) {
    const ProbeVolume volume = test::make_lit_volume(box_corners({0, 0, 0}, {4, 4, 4}));
    const auto grid = sample_grid(volume.view(), {.resolution = {4, 4, 4}});
    ASSERT_TRUE(grid);
    const LightDifference difference = measure_difference(volume.view(), *grid);
    EXPECT_EQ(difference.place_count, kDifferencePlaces);
    // Half of the places are beyond the outermost centers along an axis, where the grid is
    // constant.
    EXPECT_LT(difference.from_light.median, 0.1);
    EXPECT_GT(difference.from_light.worst, 0.0);
    EXPECT_EQ(difference.from_light, difference.without_walls);
}

}  // namespace
}  // namespace tetralight
