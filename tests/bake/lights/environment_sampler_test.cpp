// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/environment_sampler.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/sampling/sobol.h>
#include <tetralight/bake/scene/environment.h>
#include "tests/support/chi_square.h"

namespace tetralight {
namespace {

constexpr double kPi = std::numbers::pi;

/// 16 x 8 texels, dark below, with a bright one and a black region; turned.
Environment sky() {
    Environment environment;
    environment.radiance = {1.0f, 0.5f, 2.0f};
    environment.rotation_radians = 0.7f;
    environment.image = {16, 8, {}};
    for (int i = 0; i < 128; ++i) {
        environment.image.pixels.emplace_back(i < 32 ? 0.0f : 0.1f * static_cast<float>(i % 7));
    }
    environment.image.pixels[3 * 16 + 5] = {50, 40, 30};
    return environment;
}

TEST(EnvironmentSampler, PdfIntegratesToOne) {
    const EnvironmentSampler sampler(sky());
    constexpr uint32_t kCount = 200000;
    double sum = 0.0;
    for (uint32_t i = 0; i < kCount; ++i) sum += sampler.pdf(spherical_fibonacci(i, kCount));
    EXPECT_NEAR(sum * 4.0 * kPi / kCount, 1.0, 2e-3);
}

TEST(EnvironmentSampler, DirectionsAreSampledWithTheirPdf) {
    const EnvironmentSampler sampler(sky());
    constexpr uint32_t kDraws = 100000, kProbes = 2000000;
    std::vector<int> observed(test::kDirectionBins, 0);
    std::vector<double> expected(test::kDirectionBins, 0.0);
    for (uint32_t i = 0; i < kProbes; ++i) {
        const glm::vec3 d = spherical_fibonacci(i, kProbes);
        expected[test::direction_bin(d)] += sampler.pdf(d) * 4.0 * kPi / kProbes * kDraws;
    }
    for (uint32_t i = 0; i < kDraws; ++i) {
        ++observed[test::direction_bin(sampler.sample(Sampler(i, 0).next2()))];
    }
    EXPECT_TRUE(test::has_frequencies(observed, expected));
}

TEST(EnvironmentSampler, IsPositiveWhereverThereIsLight) {
    const Environment environment = sky();
    const EnvironmentSampler sampler(environment);
    for (const glm::vec3& d : spherical_fibonacci(20000)) {
        if (environment_radiance(environment, d) != glm::vec3(0.0f)) {
            EXPECT_GT(sampler.pdf(d), 0.0f);
        }
    }
}

TEST(EnvironmentSampler, MeanOfSamplesIsTheLightOfTheSky) {
    const Environment environment = sky();
    const EnvironmentSampler sampler(environment);
    constexpr uint32_t kCount = 1 << 16;
    double drawn = 0.0, even = 0.0;
    for (uint32_t i = 0; i < kCount; ++i) {
        const glm::vec3 d = sampler.sample(owen_sobol2(i, 1));
        EXPECT_NEAR(glm::length(d), 1.0f, 1e-5f);
        drawn += environment_radiance(environment, d).x / sampler.pdf(d);
        even += environment_radiance(environment, spherical_fibonacci(i, kCount)).x * 4.0 * kPi;
    }
    EXPECT_NEAR(drawn / even, 1.0, 5e-3);
}

TEST(EnvironmentSampler, AConstantSkyAndABlackOneAreEmpty) {
    Environment environment;
    EXPECT_TRUE(EnvironmentSampler(environment).is_empty());
    environment.radiance = glm::vec3(1.0f);
    EXPECT_TRUE(EnvironmentSampler(environment).is_empty());
    environment.image = {2, 1, {glm::vec3(0.0f), glm::vec3(0.0f)}};
    EXPECT_TRUE(EnvironmentSampler(environment).is_empty());
    EXPECT_EQ(EnvironmentSampler(environment).pdf({0, 1, 0}), 0.0f);
}

}  // namespace
}  // namespace tetralight
