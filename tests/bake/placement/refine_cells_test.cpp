// SPDX-License-Identifier: Apache-2.0
// The parts that the adaptive mode is made of.
#include <tetralight/bake/placement/refine_cells.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
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

/// A cube of 2 m with probes at its corners under an even sky, and sensors on the x axis beside it:
/// all light is the same, and what counts is which sensors are outside of the tetrahedra.
class RefineCells : public testing::Test {
  protected:
    RefineCells() : scene_(under_even_sky()), pool_(scene_, {}) {
        for (int i = 0; i < 8; ++i) {
            probes_.push_back(pool_.add(glm::dvec3(2 * (i % 2), 2 * (i / 2 % 2), 2 * (i / 4))));
        }
        for (const double x : {1.0, 2.5, 3.0, 4.0}) sensors_.push_back(pool_.add({x, 1.1, 0.9}));
        EXPECT_TRUE(pool_.bake({}));
    }

    static Scene under_even_sky() {
        Scene scene;
        scene.environment.radiance = glm::vec3(1.0f);
        return scene;
    }

    [[nodiscard]] std::vector<uint32_t> refine(const RefineRule& rule) {
        Sights sights(*traced_, pool_);
        const std::vector<bool> is_to_cover(pool_.size(), true);
        // Noise of the samples costs next to nothing.
        const SensorView view{pool_, sights, {ErrorKind::Absolute, 100.0}, is_to_cover};
        const ProbeVolume volume = volume_of(pool_, probes_);
        const auto errors = sensor_errors(volume, probes_, sensors_, view, 1);
        return refine_cells({probes_, volume, sensors_, errors, view}, rule);
    }

    const Scene scene_;
    const Result<TraceScene> traced_ = TraceScene::make_static(scene_);
    LightPool pool_;
    std::vector<uint32_t> probes_, sensors_;
};

TEST_F(RefineCells, ChoosesTheSensorThatCoversMostOthers) {
    // A probe at x = 4 takes those at 2.5 and 3 into the tetrahedra; one at 3 takes one.
    const auto any = [](uint32_t) { return true; };
    EXPECT_EQ(refine({0.05, any, 1, 0}), std::vector<uint32_t>{sensors_[3]});
}

TEST_F(RefineCells, TakesTheNextBestWhereNoProbeMayBe) {
    const auto others = [&](uint32_t sensor) { return sensor != sensors_[3]; };
    EXPECT_EQ(refine({0.05, others, 1, 0}), std::vector<uint32_t>{sensors_[2]});
    EXPECT_TRUE(refine({0.05, [](uint32_t) { return false; }, 1, 0}).empty());
}

TEST_F(RefineCells, KeepsTheClearanceBetweenProbes) {
    // From x = 4 the nearest corners are √(2² + 0.9² + 0.9²) = 2.37 m away.
    const auto any = [](uint32_t) { return true; };
    EXPECT_EQ(refine({2.3, any, 1, 0}).size(), 1u);
    EXPECT_TRUE(refine({2.4, any, 1, 0}).empty());
}

/// Noise may cost this, which is less than one uncovered place does.
constexpr RemoveRule kLittleCost{.min_probe_count = 8, .max_cost = 1.0};
/// Any error is fine, but no uncovered place.
constexpr RemoveRule kAllCovered{.min_probe_count = 8, .max_cost = 1e9, .max_uncovered = 0};

class RemoveProbes : public testing::Test {
  protected:
    RemoveProbes() : scene_(even_sky()), pool_(scene_, {}) {
        for (int i = 0; i < 64; ++i) probes_.push_back(pool_.add({i % 4, i / 4 % 4, i / 16}));
    }

    static Scene even_sky() {
        Scene scene;
        scene.environment.radiance = glm::vec3(1.0f);
        return scene;
    }

    /// Removes probes, pass by pass, with these sensors.
    void remove_all(const std::vector<uint32_t>& sensors, RemoveRule rule) {
        ASSERT_TRUE(pool_.bake({}));
        std::vector<bool> is_protected(pool_.size(), false);
        is_protected[21] = true;
        Sights sights(*traced_, pool_);
        const std::vector<bool> is_to_cover(pool_.size(), true);
        const SensorView view{pool_, sights, {ErrorKind::Absolute, 1.0}, is_to_cover};
        ProbeRemover remover(view);
        for (int pass = 0; pass < 40 && probes_.size() > rule.min_probe_count; ++pass) {
            const ProbeVolume volume = volume_of(pool_, probes_);
            errors_ = sensor_errors(volume, probes_, sensors, view, 1);
            const std::vector<uint32_t> spaces(probes_.size(), 0);  // all in one
            probes_ = remover.pass({probes_, spaces, volume, sensors, errors_, is_protected}, rule);
        }
        errors_ = sensor_errors(volume_of(pool_, probes_), probes_, sensors, view, 1);
        EXPECT_NE(std::ranges::find(probes_, 21u), probes_.end());
    }

    [[nodiscard]] size_t uncovered_count() const {
        return static_cast<size_t>(std::ranges::count(errors_, false, &SensorError::is_covered));
    }

    const Scene scene_;
    const Result<TraceScene> traced_ = TraceScene::make_static(scene_);
    LightPool pool_;
    std::vector<uint32_t> probes_;
    std::vector<SensorError> errors_;
};

TEST_F(RemoveProbes, LeavesFewProbesWhereLightIsEven) {
    // Around the centre, where eight probes can hold all sensors.
    std::vector<uint32_t> sensors;
    for (int i = 0; i < 100; ++i) {
        sensors.push_back(pool_.add({1.0 + 0.01 * i, 1.2 + 0.006 * i, 2.0 - 0.01 * i}));
    }
    remove_all(sensors, kLittleCost);
    EXPECT_LE(probes_.size(), 16u);
    EXPECT_EQ(uncovered_count(), 0u);
}

class RemoveCorners : public RemoveProbes, public testing::WithParamInterface<RemoveRule> {};

TEST_P(RemoveCorners, KeepsWhatHoldsPlacesInsideTheTetrahedra) {
    // In the corners: without a corner's probe its sensor is outside.
    std::vector<uint32_t> sensors;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner(i % 2 * 3, i / 2 % 2 * 3, i / 4 * 3);
        sensors.push_back(pool_.add(glm::mix(corner, glm::dvec3(1.5), 0.1)));
    }
    remove_all(sensors, GetParam());
    EXPECT_EQ(uncovered_count(), 0u);
    for (const uint32_t corner : {0u, 3u, 12u, 15u, 48u, 51u, 60u, 63u}) {
        EXPECT_NE(std::ranges::find(probes_, corner), probes_.end()) << corner;
    }
    EXPECT_LE(probes_.size(), 16u);
}

INSTANTIATE_TEST_SUITE_P(RemoveProbes, RemoveCorners, testing::Values(kLittleCost, kAllCovered));

}  // namespace
}  // namespace tetralight
