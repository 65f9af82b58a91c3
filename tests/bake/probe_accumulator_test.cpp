// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/probe_accumulator.h>

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
    result.sample_count = directions;
    result.ray_count = 3 * directions;
    return result;
}

/// Light of one coefficient, in red.
RadianceSh light(int coefficient, float value) {
    RadianceSh radiance;
    radiance.coefficients[coefficient].x = value;
    return radiance;
}

ProbeAccumulator tally_of(const std::vector<ProbeEstimate>& estimates) {
    ProbeAccumulator accumulator;
    accumulator.add_round(estimates);
    return accumulator;
}

TEST(ProbeAccumulator, EmptyIsBlackAndFree) {
    EXPECT_EQ(ProbeAccumulator{}.radiance(), RadianceSh{});
    EXPECT_EQ(ProbeAccumulator{}.validity(), 1.0f);
    EXPECT_EQ(ProbeAccumulator{}.standard_error(), 0.0f);
}

TEST(ProbeAccumulator, EverySampleHasTheSameWeight) {
    ProbeAccumulator accumulator =
        tally_of({estimate(light(0, 1.0f), 10), estimate(light(0, 2.0f), 30)});
    EXPECT_EQ(accumulator.radiance(), light(0, 1.75f));
    accumulator.add_round(std::vector{estimate(light(0, 3.75f), 40)});
    EXPECT_EQ(accumulator.radiance(), light(0, 2.75f));
    EXPECT_EQ(accumulator.sample_count, 80u);
    EXPECT_EQ(accumulator.ray_count, 240u);
    EXPECT_EQ(accumulator.round_count, 2u);
}

TEST(ProbeAccumulator, ValidityIsTheFractionOfSamplesWithoutBackFaces) {
    ProbeEstimate behind = estimate({}, 30);
    behind.back_face_count = 10;
    EXPECT_EQ(tally_of({estimate({}, 10), behind}).validity(), 0.75f);
}

TEST(ProbeAccumulator, StandardErrorIsThatOfTheMean) {
    // 1 and 3: mean 2, variance of one 2, of the mean 1.
    const ProbeAccumulator accumulator =
        tally_of({estimate(light(0, 1.0f)), estimate(light(0, 3.0f))});
    EXPECT_NEAR(accumulator.standard_error(), 0.5, 1e-6);
}

TEST(ProbeAccumulator, BandsAreWeightedAsInIrradiance) {
    // The same spread, ±1 and with it a standard error of 1, in another band than the light.
    for (const auto& [coefficient, factor] : {std::pair{2, 2.0 / 3.0}, std::pair{6, 1.0 / 4.0}}) {
        const ProbeAccumulator accumulator =
            tally_of({estimate(light(0, 4.0f) + light(coefficient, 1.0f)),
                      estimate(light(0, 4.0f) + light(coefficient, -1.0f))});
        EXPECT_NEAR(accumulator.standard_error(), factor / 4.0, 1e-6);
    }
}

TEST(ProbeAccumulator, StandardErrorIsTheRootMeanSquareOverNormals) {
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
    const ProbeAccumulator accumulator =
        tally_of({estimate(mean + offset), estimate(mean + -1.0f * offset)});
    EXPECT_NEAR(accumulator.standard_error(), std::sqrt(error / square), 1e-4);
}

TEST(ProbeAccumulator, RoundsAddUpAsIndependentOnesDo) {
    // Each round's mean has variance 1; the mean of both has (10² · 1 + 30² · 1) / 40².
    ProbeAccumulator accumulator =
        tally_of({estimate(light(0, 1.0f), 5), estimate(light(0, 3.0f), 5)});
    accumulator.add_round(std::vector{estimate(light(0, 1.0f), 15), estimate(light(0, 3.0f), 15)});
    EXPECT_NEAR(accumulator.standard_error(), std::sqrt(1000.0 / 1600.0) / 2.0, 1e-6);
}

TEST(ProbeAccumulator, OneEstimateHasNoStandardError) {
    EXPECT_EQ(tally_of({estimate(light(0, 1.0f))}).standard_error(), 0.0f);
}

TEST(ProbeAccumulator, StandardErrorIsUnbiasedForEstimatesOfDifferentSize) {
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
