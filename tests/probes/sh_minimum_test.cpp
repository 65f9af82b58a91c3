// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/sh_minimum.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "tests/support/random_light.h"

namespace tetralight {
namespace {

constexpr double kBand0 = 0.28209479177387814;

/// xᵀ diag(form) x + linear · x with a trace of 0, in the red channel.
IrradianceSh polynomial(const glm::dvec3& form, const glm::dvec3& linear) {
    IrradianceSh sh;
    sh.coefficients[1].r = static_cast<float>(linear.y / 0.48860251190291992);
    sh.coefficients[2].r = static_cast<float>(linear.z / 0.48860251190291992);
    sh.coefficients[3].r = static_cast<float>(linear.x / 0.48860251190291992);
    sh.coefficients[6].r = static_cast<float>(form.z / (2 * 0.31539156525252001));
    sh.coefficients[8].r = static_cast<float>((form.x - form.y) / (2 * 0.54627421529603953));
    return sh;
}

TEST(ShMinimum, OfADistantLightIsFourPercentOfItsPeakBelowZero) {
    // E(t) = 1/4 + t/2 + 15/32 t² − 5/32 with t = cos of the angle to the light; least at t =
    // −8/15.
    const IrradianceSh sh = irradiance_from_radiance(
        radiance_from_directional_light(glm::normalize(glm::vec3(1, 2, -3)), {1.0f, 2.0f, 0.0f}));
    const double expected = 1.0 / 4 - 5.0 / 32 - 2.0 / 15;
    EXPECT_NEAR(minimum_irradiance(sh).r, expected, 1e-6);
    EXPECT_NEAR(minimum_irradiance(sh).g, 2 * expected, 2e-6);
    EXPECT_EQ(minimum_irradiance(sh).b, 0.0);
}

TEST(ShMinimum, OfConstantLightIsTheLight) {
    IrradianceSh sh;
    sh.coefficients[0] = {3.0f, -2.0f, 0.0f};
    const glm::dvec3 least = minimum_irradiance(sh);
    EXPECT_DOUBLE_EQ(least.r, 3.0 * kBand0);
    EXPECT_DOUBLE_EQ(least.g, -2.0 * kBand0);
    EXPECT_EQ(least.b, 0.0);
}

TEST(ShMinimum, OfAQuadraticFormIsItsLeastEigenvalue) {
    EXPECT_NEAR(minimum_irradiance(polynomial({3, -1, -2}, {})).r, -2.0, 1e-6);
    EXPECT_NEAR(minimum_irradiance(polynomial({1, 1, -2}, {})).r, -2.0, 1e-6);
    EXPECT_NEAR(minimum_irradiance(polynomial({-1, -1, 2}, {})).r, -1.0, 1e-6);  // a whole circle
}

TEST(ShMinimum, IsFoundWhereTwoNormalsAreEquallyDark) {
    // −2z² + 3x² − y² + 2x: on x = a, z² = 1 − a² it is 5a² + 2a − 2, least at a = −1/5, for +z and
    // −z alike; the slope has no part along z.
    EXPECT_NEAR(minimum_irradiance(polynomial({3, -1, -2}, {2, 0, 0})).r, -2.2, 1e-6);
    // The same with a whisper of z.
    EXPECT_NEAR(minimum_irradiance(polynomial({3, -1, -2}, {2, 0, 1e-12})).r, -2.2, 1e-6);
}

TEST(ShMinimum, IsNeverAboveASampleAndAlwaysNearTheLeastOne) {
    std::mt19937_64 engine(7);
    const auto directions = test::dense_directions();
    for (int round = 0; round < 200; ++round) {
        const IrradianceSh sh =
            round % 2 == 0 ? test::arbitrary_irradiance(engine) : test::ringing_light(engine);
        glm::vec3 sampled(1e9f);
        for (const glm::vec3& n : directions)
            sampled = glm::min(sampled, evaluate_irradiance(sh, n));
        const glm::dvec3 least = minimum_irradiance(sh);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_LE(least[channel], sampled[channel] + 2e-6) << round;
            // Around its minimum it rises by less than 10 · distance².
            EXPECT_GE(least[channel], sampled[channel] - 10 * 0.01 * 0.01) << round;
        }
    }
}

TEST(ShMinimum, TurnsWithTheLight) {
    std::mt19937_64 engine(8);
    for (int round = 0; round < 100; ++round) {
        const IrradianceSh sh = test::arbitrary_irradiance(engine);
        const glm::vec3 x = test::random_direction(engine);
        const glm::vec3 y = glm::normalize(glm::cross(x, test::random_direction(engine)));
        const glm::dvec3 turned = minimum_irradiance(rotate(sh, {x, y, glm::cross(x, y)}));
        EXPECT_NEAR(turned.r, minimum_irradiance(sh).r, 2e-6);
    }
}

TEST(ShMinimum, ScalesWithTheLight) {
    std::mt19937_64 engine(9);
    for (int round = 0; round < 100; ++round) {
        const IrradianceSh sh = test::arbitrary_irradiance(engine);
        const double least = minimum_irradiance(sh).r;
        EXPECT_NEAR(minimum_irradiance(sh * 0x1p40f).r, least * 0x1p40, 1e-12 * 0x1p40);
        EXPECT_NEAR(minimum_irradiance(sh * 0x1p-40f).r, least * 0x1p-40, 1e-12 * 0x1p-40);
    }
}

}  // namespace
}  // namespace tetralight
