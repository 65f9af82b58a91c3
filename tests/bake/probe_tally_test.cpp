// SPDX-License-Identifier: Apache-2.0
#include "bake/probe_tally.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace tetralight {
namespace {

constexpr double kPi = std::numbers::pi;

ProbeEstimate estimate(const RadianceSh& radiance, uint32_t directions = 10) {
    ProbeEstimate result;
    result.radiance = radiance;
    result.direction_count = directions;
    result.ray_count = 3 * directions;
    return result;
}

/// Light of one coefficient, in red.
RadianceSh light(int coefficient, float value) {
    RadianceSh radiance;
    radiance.coefficients[coefficient].x = value;
    return radiance;
}

ProbeTally tally_of(const std::vector<ProbeEstimate>& estimates) {
    ProbeTally tally;
    tally.add_round(estimates);
    return tally;
}

TEST(ProbeTally, EmptyIsBlackAndFree) {
    EXPECT_EQ(ProbeTally{}.radiance(), RadianceSh{});
    EXPECT_EQ(ProbeTally{}.validity(), 1.0f);
    EXPECT_EQ(ProbeTally{}.standard_error(), 0.0f);
}

TEST(ProbeTally, EachDirectionCountsTheSame) {
    ProbeTally tally = tally_of({estimate(light(0, 1.0f), 10), estimate(light(0, 2.0f), 30)});
    EXPECT_EQ(tally.radiance(), light(0, 1.75f));
    tally.add_round(std::vector{estimate(light(0, 3.75f), 40)});
    EXPECT_EQ(tally.radiance(), light(0, 2.75f));
    EXPECT_EQ(tally.direction_count, 80u);
    EXPECT_EQ(tally.ray_count, 240u);
    EXPECT_EQ(tally.round_count, 2u);
}

TEST(ProbeTally, ValidityIsTheShareOfDirectionsThatMeetNoBack) {
    ProbeEstimate behind = estimate({}, 30);
    behind.behind_count = 10;
    EXPECT_EQ(tally_of({estimate({}, 10), behind}).validity(), 0.75f);
}

TEST(ProbeTally, StandardErrorIsThatOfTheMean) {
    // 1 and 3: mean 2, variance of one 2, of the mean 1.
    const ProbeTally tally = tally_of({estimate(light(0, 1.0f)), estimate(light(0, 3.0f))});
    EXPECT_NEAR(tally.standard_error(), 0.5, 1e-6);
}

TEST(ProbeTally, BandsCountAsMuchAsTheyDoInIrradiance) {
    // The same spread, ±1 and with it a standard error of 1, in another band than the light.
    for (const auto& [coefficient, factor] : {std::pair{2, 2.0 / 3.0}, std::pair{6, 1.0 / 4.0}}) {
        const ProbeTally tally = tally_of({estimate(light(0, 4.0f) + light(coefficient, 1.0f)),
                                           estimate(light(0, 4.0f) + light(coefficient, -1.0f))});
        EXPECT_NEAR(tally.standard_error(), factor / 4.0, 1e-6);
    }
}

TEST(ProbeTally, StandardErrorIsTheRootMeanSquareOverNormals) {
    std::mt19937 engine(1);
    std::normal_distribution<float> normal;
    RadianceSh mean = light(0, 3.0f), offset;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            mean.coefficients[i][channel] += normal(engine);
            offset.coefficients[i][channel] = 0.1f * normal(engine);
        }
    }
    double error = 0.0, square = 0.0;  // over a lattice of normals, three channels each
    for (int i = 0; i < 2000; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / 2000.0, angle = 2.0 * kPi * std::numbers::phi * i;
        const double radius = std::sqrt(1.0 - z * z);
        const glm::vec3 n(radius * std::cos(angle), radius * std::sin(angle), z);
        const glm::vec3 d = evaluate_irradiance(irradiance_from_radiance(offset), n);
        const glm::vec3 e = evaluate_irradiance(irradiance_from_radiance(mean), n);
        error += d.x * d.x + d.y * d.y + d.z * d.z;
        square += e.x * e.x + e.y * e.y + e.z * e.z;
    }
    // Two estimates, mean ± offset: the standard error of their mean is the offset.
    const ProbeTally tally = tally_of({estimate(mean + offset), estimate(mean + -1.0f * offset)});
    EXPECT_NEAR(tally.standard_error(), std::sqrt(error / square), 1e-4);
}

TEST(ProbeTally, RoundsAddUpAsIndependentOnesDo) {
    // Each round's mean has variance 1; the mean of both has (10² · 1 + 30² · 1) / 40².
    ProbeTally tally = tally_of({estimate(light(0, 1.0f), 5), estimate(light(0, 3.0f), 5)});
    tally.add_round(std::vector{estimate(light(0, 1.0f), 15), estimate(light(0, 3.0f), 15)});
    EXPECT_NEAR(tally.standard_error(), std::sqrt(1000.0 / 1600.0) / 2.0, 1e-6);
}

TEST(ProbeTally, OneEstimateTellsNoError) {
    EXPECT_EQ(tally_of({estimate(light(0, 1.0f))}).standard_error(), 0.0f);
}

TEST(ProbeTally, StandardErrorIsUnbiasedForEstimatesOfDifferentSize) {
    // Estimates of n directions with variance 1/n about 100: that of the mean of 60 is 1/60.
    std::mt19937 engine(2);
    std::normal_distribution<double> normal;
    double sum = 0.0;
    constexpr int kTrials = 4000;
    for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<ProbeEstimate> estimates;
        for (const uint32_t n : {5u, 10u, 15u, 30u}) {
            const double value = 100.0 + normal(engine) / std::sqrt(n);
            estimates.push_back(estimate(light(0, static_cast<float>(value)), n));
        }
        const double relative = tally_of(estimates).standard_error();
        sum += relative * relative * 100.0 * 100.0;
    }
    EXPECT_NEAR(sum / kTrials, 1.0 / 60.0, 0.05 / 60.0);  // σ of the mean is 1.3 %
}

}  // namespace
}  // namespace tetralight
