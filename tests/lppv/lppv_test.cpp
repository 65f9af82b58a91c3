// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/lppv/lppv.h>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <thread>

#include "tests/lppv/lppv_fixture.h"

namespace tetralight {
namespace {

using test::grid_in_box;
using test::make_cube_volume;

void expect_linear_light(const InterpolatedProbe& light, const glm::vec3& position) {
    const IrradianceSh expected = test::linear_light(glm::dvec3(position));
    for (int i = 0; i < kShCoefficientCount; ++i) {
        EXPECT_LE(glm::distance(light.irradiance.coefficients[i], expected.coefficients[i]),
                  4e-5f * (1.0f + glm::length(expected.coefficients[i])));
    }
}

TEST(Lppv, ReproducesALinearLightFieldBetweenItsPoints) {
    const ProbeVolume volume = make_cube_volume();
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> inside(-0.5, 0.5);
    for (const glm::dvec3 scale : {glm::dvec3(1.5), glm::dvec3(2, 0.5, 1), glm::dvec3(1, -2, 1)}) {
        for (const auto placement : {LppvPlacement::CellCorners, LppvPlacement::CellCenters}) {
            const LppvGrid grid = grid_in_box({4, 3, 7}, scale, 35.0, placement);
            const Lppv lppv = *make_lppv(volume.view(), grid, {});
            // Centres clamp half a spacing from the faces: stay among the points.
            const glm::dvec3 room = 0.999 * glm::dvec3(grid.resolution - 1u) * grid.step;
            for (int i = 0; i < 200; ++i) {
                const glm::dvec3 share(inside(engine), inside(engine), inside(engine));
                const glm::vec3 p(grid.world_from_local * glm::dvec4(share * room, 1.0));
                expect_linear_light(sample_lppv(lppv, p), p);
            }
        }
    }
}

TEST(Lppv, ClampsOutsideToTheNearestPlaceAmongItsPoints) {
    const ProbeVolume volume = make_cube_volume();
    const LppvGrid grid = grid_in_box({3, 4, 5}, glm::dvec3(2.0), 0.0);
    const Lppv lppv = *make_lppv(volume.view(), grid, {});
    EXPECT_EQ(sample_lppv(lppv, {9, 0.25f, -0.5f}), sample_lppv(lppv, {1, 0.25f, -0.5f}));
    EXPECT_EQ(sample_lppv(lppv, {-9, -8, 7}), sample_lppv(lppv, {-1, -1, 1}));
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(sample_lppv(lppv, {kNan, kNan, kNan}).irradiance, lppv.irradiance[0]);
}

TEST(Lppv, AnAxisOfOnePointIsConstant) {
    const ProbeVolume volume = make_cube_volume();
    const LppvGrid grid = grid_in_box({3, 1, 3}, glm::dvec3(2.0), 0.0);
    const Lppv lppv = *make_lppv(volume.view(), grid, {});
    EXPECT_EQ(sample_lppv(lppv, {0.3f, 0.9f, 0}), sample_lppv(lppv, {0.3f, -0.4f, 0}));
    expect_linear_light(sample_lppv(lppv, {0.3f, 0.9f, 0}), {0.3f, 0.0f, 0.0f});
}

TEST(Lppv, EveryPointHoldsTheAnswerOfASingleQuery) {
    ProbeVolume volume = test::make_random_volume(test::random_positions(300, 3), 4);
    volume.occlusion.assign(volume.positions.size(), glm::vec4(0.25f, 0.5f, 0.75f, 1.0f));
    // Beams of 8 x 8 rows: whole and cut ones, and one alone.
    for (const glm::uvec3 resolution : {glm::uvec3(37, 19, 41), glm::uvec3(50, 7, 90)}) {
        const LppvGrid grid = grid_in_box(resolution, glm::dvec3(1.7), 20.0);
        const Lppv lppv = *make_lppv(volume.view(), grid, {});
        ASSERT_EQ(lppv.occlusion.size(), grid.point_count());
        for (size_t i = 0; i < grid.point_count(); i += 7) {
            const glm::vec3 position(grid.world_position(grid.point(i)));
            const InterpolatedProbe expected =
                interpolate(volume.view(), locate(volume.view(), position));
            for (int k = 0; k < kShCoefficientCount; ++k) {
                ASSERT_LE(glm::distance(lppv.irradiance[i].coefficients[k],
                                        expected.irradiance.coefficients[k]),
                          1e-4f);
            }
            ASSERT_LE(glm::distance(lppv.occlusion[i], expected.occlusion), 1e-5f);
        }
    }
}

TEST(Lppv, GivesTheSameBytesOnAnyThreads) {
    const ProbeVolume volume = test::make_random_volume(test::random_positions(300, 3), 4);
    const LppvGrid grid = grid_in_box({40, 40, 40}, glm::dvec3(2.2), 20.0);
    const LppvFill fill{.quality = LppvQuality::Normal};
    const auto threads = [](size_t count, auto&& task) {
        std::vector<std::jthread> workers;
        for (size_t i = count; i-- > 0;) workers.emplace_back([&task, i] { task(i); });
    };
    EXPECT_EQ(*make_lppv(volume.view(), grid, fill),
              *make_lppv(volume.view(), grid, fill, threads));
}

TEST(Lppv, FillsAGridAgainInTheMemoryThatItHas) {
    const ProbeVolume volume = test::make_random_volume(test::random_positions(300, 3), 4);
    Lppv lppv = *make_lppv(volume.view(), grid_in_box({9, 10, 11}, glm::dvec3(2.2), 20.0), {});
    const IrradianceSh* memory = lppv.irradiance.data();
    lppv.grid = grid_in_box({11, 9, 10}, glm::dvec3(1.5), 70.0);
    const std::vector<float> validity(lppv.grid.point_count(), 0.75f);
    const LppvFill fill{.quality = LppvQuality::Low, .validity = validity};
    ASSERT_TRUE(fill_lppv(volume.view(), fill, lppv));
    EXPECT_EQ(lppv, *make_lppv(volume.view(), lppv.grid, fill));
    EXPECT_EQ(lppv.irradiance.data(), memory);
    // The mask may be its own.
    lppv.validity[0] = 0.0f;
    ASSERT_TRUE(fill_lppv(volume.view(), {.validity = lppv.validity}, lppv));
    EXPECT_EQ(lppv.replaced_count, 1u);
    EXPECT_EQ(lppv.irradiance[0], lppv.irradiance[1]);
}

TEST(Lppv, QualitiesDifferInBand2Only) {
    const ProbeVolume volume = make_cube_volume();
    const LppvGrid grid = grid_in_box({4, 3, 2}, glm::dvec3(2.0), 0.0);
    const Lppv full = *make_lppv(volume.view(), grid, {});
    const Lppv normal = *make_lppv(volume.view(), grid, {.quality = LppvQuality::Normal});
    const Lppv low = *make_lppv(volume.view(), grid, {.quality = LppvQuality::Low});
    for (size_t point = 0; point < grid.point_count(); ++point) {
        for (int i = 0; i < kShCoefficientCount; ++i) {
            const glm::vec3 c = full.irradiance[point].coefficients[i];
            if (i < 4) {
                EXPECT_EQ(normal.irradiance[point].coefficients[i], c);
                EXPECT_EQ(low.irradiance[point].coefficients[i], c);
                continue;
            }
            // The mean of linear light over a grid is that of its centre, the origin.
            const glm::vec3 mean = test::linear_light(glm::dvec3(0.0)).coefficients[i];
            EXPECT_LE(glm::distance(normal.irradiance[point].coefficients[i], mean), 1e-4f);
            EXPECT_EQ(low.irradiance[point].coefficients[i], glm::vec3(0.0f));
        }
    }
}

TEST(Lppv, InvalidPointsTakeTheLightOfTheNearestValidOne) {
    ProbeVolume volume = make_cube_volume();
    volume.occlusion.assign(volume.positions.size(), glm::vec4(0.5f));
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        volume.occlusion[i].x = 0.5f + 0.25f * volume.positions[i].x;
    }
    const LppvGrid grid = grid_in_box({5, 2, 2}, glm::dvec3(2.0), 0.0);
    std::vector<float> validity(grid.point_count(), 1.0f);
    validity[1] = 0.4f;
    validity[2] = 0.0f;
    const Lppv all = *make_lppv(volume.view(), grid, {});
    const Lppv masked = *make_lppv(volume.view(), grid, {.validity = validity});
    EXPECT_EQ(masked.replaced_count, 2u);
    EXPECT_EQ(masked.irradiance[1], all.irradiance[0]);
    EXPECT_EQ(masked.occlusion[1], all.occlusion[0]);
    EXPECT_EQ(masked.irradiance[2], all.irradiance[3]);
    EXPECT_EQ(masked.irradiance[4], all.irradiance[4]);
    EXPECT_EQ(masked.validity, validity);
}

TEST(Lppv, KeepsItsOwnLightWhereNothingIsValid) {
    const ProbeVolume volume = make_cube_volume();
    const LppvGrid grid = grid_in_box({2, 2, 2}, glm::dvec3(2.0), 0.0);
    const std::vector<float> validity(8, 0.0f);
    const Lppv lppv = *make_lppv(volume.view(), grid, {.validity = validity});
    EXPECT_EQ(lppv.irradiance, make_lppv(volume.view(), grid, {})->irradiance);
    EXPECT_EQ(lppv.replaced_count, 0u);
}

TEST(Lppv, RefusesAMaskOfAnotherLength) {
    const ProbeVolume volume = make_cube_volume();
    const std::vector<float> validity(7, 1.0f);
    const auto lppv = make_lppv(volume.view(), grid_in_box({2, 2, 2}, glm::dvec3(1.0), 0.0),
                                {.validity = validity});
    ASSERT_FALSE(lppv);
    EXPECT_EQ(error_text(lppv.error()), "validity has 7 values, but the grid has 8 points");
}

TEST(Lppv, WithoutProbesIsAmbient) {
    ProbeVolume volume;
    volume.info.ambient = test::linear_light({1, 2, 3});
    const Lppv lppv = *make_lppv(volume.view(), grid_in_box({2, 2, 2}, glm::dvec3(1.0), 0.0), {});
    EXPECT_EQ(sample_lppv(lppv, {-9, -9, -9}).irradiance, volume.info.ambient);
    EXPECT_EQ(sample_lppv(lppv, {0, 0, 0}).occlusion, glm::vec4(1.0f));
}

/// A volume with walls whose probes are on two layers, and an object that is on one of them.
TEST(Lppv, PointsTakeTheLightOfProbesOnTheLayersOfTheObject) {
    const ProbeVolume volume = test::make_walled_volume();
    const LppvGrid grid = grid_in_box({9, 10, 11}, glm::dvec3(1.7), 20.0);
    for (const Receiver& receiver :
         {Receiver{.rendering_layers = 0b01}, Receiver{.radius = 0.5f},
          Receiver{Walls::Ignore, 0b10, 0.0f}, Receiver{.walls = Walls::Ignore}}) {
        const Lppv lppv = *make_lppv(volume.view(), grid, {.receiver = receiver});
        EXPECT_NE(lppv, *make_lppv(volume.view(), grid, {}));
        for (size_t i = 0; i < grid.point_count(); ++i) {
            const glm::vec3 position(grid.world_position(grid.point(i)));
            const IrradianceSh expected =
                interpolate(volume.view(), locate(volume.view(), position), receiver).irradiance;
            for (int k = 0; k < kShCoefficientCount; ++k) {
                ASSERT_LE(
                    glm::distance(lppv.irradiance[i].coefficients[k], expected.coefficients[k]),
                    1e-4f);
            }
        }
    }
}

}  // namespace
}  // namespace tetralight
