// SPDX-License-Identifier: Apache-2.0
// The parts that the adaptive mode is made of.
#include <tetralight/bake/placement/refine_cells.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/light_difference.h>
#include <tetralight/bake/placement/remove_probes.h>
#include <tetralight/bake/placement/sensors.h>
#include "tests/bake/placement/grid_support.h"

namespace tetralight {
namespace {

using test::add_box;
using test::Facing;

TEST(LightDifference, OfEvenLightIsTheLight) {
    // Constant radiance 1: irradiance π for every normal.
    const IrradianceSh light = irradiance_from_radiance(constant_radiance(glm::vec3(1.0f)));
    EXPECT_NEAR(mean_irradiance(light), std::numbers::pi, 1e-5);
    EXPECT_NEAR(mean_square(light), std::numbers::pi * std::numbers::pi, 1e-4);
}

TEST(LightDifference, IsTheMeanOverTheNormals) {
    IrradianceSh light;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        light.coefficients[i] = glm::vec3(0.1f * float(i), 1.0f - 0.2f * float(i), 0.3f);
    }
    double sum = 0.0, squares = 0.0;
    for (int n = 0; n < 27; ++n) {
        if (n == 13) continue;
        const glm::vec3 normal = glm::normalize(glm::vec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
        const glm::dvec3 e(evaluate_irradiance(light, normal));
        sum += (e.x + e.y + e.z) / 3.0;
        squares += glm::dot(e, e) / 3.0;
    }
    EXPECT_NEAR(mean_irradiance(light), sum / 26.0, 1e-5);
    EXPECT_NEAR(mean_square(light), squares / 26.0, 1e-4);
}

std::vector<glm::dvec3> pair_through(const Scene& scene, double clearance) {
    const auto traced = TraceScene::make_static(scene);
    return pair_at_wall(*traced, {1, 1, 0}, {-1, 1, 0.4}, clearance, 1.0);
}

TEST(PairAtWall, StandsOnBothSidesOfASheet) {
    Scene scene;
    test::add_quad(scene, test::two_sided(), {0, -5, -5}, {0, 10, 0}, {0, 0, 10});
    const auto pair = pair_through(scene, 0.1);
    ASSERT_EQ(pair.size(), 2u);
    EXPECT_LT(glm::distance(pair[0], glm::dvec3(0.1, 1, 0.2)), 1e-5);
    EXPECT_LT(glm::distance(pair[1], glm::dvec3(-0.1, 1, 0.2)), 1e-5);
}

TEST(PairAtWall, StandsOnBothSidesOfASolidThinnerThanTheClearance) {
    Scene scene;
    add_box(scene, test::grey(), Facing::Outward, {-0.02f, -5, -5}, {0.02f, 5, 5});
    const auto pair = pair_through(scene, 0.1);
    ASSERT_EQ(pair.size(), 2u);
    EXPECT_NEAR(pair[0].x, 0.12, 1e-5);
    EXPECT_NEAR(pair[1].x, -0.12, 1e-4);
}

TEST(PairAtWall, IsAloneBeforeAThickWallAndNothingInTheOpen) {
    Scene scene;
    add_box(scene, test::grey(), Facing::Outward, {-9, -5, -5}, {0, 5, 5});
    EXPECT_EQ(pair_through(scene, 0.1).size(), 1u);
    EXPECT_TRUE(pair_through(Scene{}, 0.1).empty());
}

TEST(SensorSequence, AreFreeHalfOfThemOffSurfaces) {
    Scene scene;
    add_box(scene, test::grey(), Facing::Outward, {-1, -1, -1}, {1, 1, 1});
    const auto traced = TraceScene::make_static(scene);
    SensorSequence places(*traced, {{-2, -2, -2}, {2, 2, 2}}, 0.05, [&](const glm::dvec3& p) {
        return is_free_with_clearance(*traced, p, 0.025);
    });
    const auto found = places.next(1000, 0);
    ASSERT_EQ(found.size(), 1000u);
    size_t near = 0;
    for (const glm::dvec3& p : found) {
        const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        EXPECT_GT(farthest, 1.0);
        EXPECT_LE(farthest, 2.0);
        near += std::abs(farthest - 1.05) < 1e-4;
    }
    // Of the others an eighth falls into the box and is tried again.
    EXPECT_NEAR(static_cast<double>(near), 1000.0 * 0.5 / (0.5 + 0.5 * 7.0 / 8.0), 30.0);
    EXPECT_NE(places.next(10, 0), std::vector<glm::dvec3>(found.begin(), found.begin() + 10));
}

/// A cell with most of the error, where no probe may stand, does not end the refinement of others.
TEST(RefineCells, GoesOnPastCellsThatCannotBeRefined) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    const auto traced = TraceScene::make_static(scene);
    LightPool pool(scene, {});
    std::vector<uint32_t> probes, sensors;
    for (int i = 0; i < 27; ++i) probes.push_back(pool.add({i % 3, i / 3 % 3, i / 9}));
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner(i % 2, i / 2 % 2, i / 4);
        sensors.push_back(pool.add(corner + glm::dvec3(0.45, 0.55, 0.52)));
    }
    ASSERT_TRUE(pool.bake({}));
    const ProbeVolume volume = volume_of(pool, probes);
    auto errors = sensor_errors(volume, pool, sensors, nullptr, 1);
    for (SensorError& error : errors) error.square = error.visible_square = 1.0f;
    errors[3].square = errors[3].visible_square = 1000.0f;
    const RefineRule rule{0.05, [&](uint32_t sensor) { return sensor != sensors[3]; },
                          [](const glm::dvec3&) { return true; }, 100};
    Refinement refinement = refine_cells({volume, pool, sensors, errors, *traced}, rule);
    std::ranges::sort(refinement.sensors);
    std::vector<uint32_t> others = sensors;
    others.erase(others.begin() + 3);
    EXPECT_EQ(refinement.sensors, others);
}

TEST(ProbeRemover, RemovesWhatInterpolationMakesGoodAlready) {
    // Light under an even sky is the same everywhere: only the fewest probes are left, and of
    // those that are protected all.
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    LightPool pool(scene, {});
    std::vector<uint32_t> probes, sensors;
    for (int i = 0; i < 64; ++i) probes.push_back(pool.add({i % 4, i / 4 % 4, i / 16}));
    for (int i = 0; i < 100; ++i) {
        sensors.push_back(pool.add({0.03 * i, 1.5 + 0.01 * i, 3.0 - 0.03 * i}));
    }
    ASSERT_TRUE(pool.bake({}));
    std::vector<bool> is_protected(pool.size(), false);
    is_protected[21] = true;
    ProbeRemover remover(pool);
    RemoveRule rule;
    rule.min_probe_count = 8;
    rule.max_square_sum = 1.0;  // noise: of 128 directions
    for (int pass = 0; pass < 40 && probes.size() > rule.min_probe_count; ++pass) {
        const ProbeVolume volume = volume_of(pool, probes);
        const auto errors = sensor_errors(volume, pool, sensors, nullptr, 1);
        const std::vector<uint32_t> spaces(probes.size(), 0);  // all in one
        probes = remover.pass({probes, spaces, volume, sensors, errors, is_protected}, rule);
    }
    EXPECT_EQ(probes.size(), 8u);
    EXPECT_NE(std::find(probes.begin(), probes.end(), 21u), probes.end());
}

}  // namespace
}  // namespace tetralight
