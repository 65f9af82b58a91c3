// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/plain_sky.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tetralight {
namespace {

/// Dim, with a sun of one pixel.
Environment sky_with_a_sun() {
    Environment sky;
    sky.radiance = glm::vec3(2.0f);
    sky.rotation_radians = 0.7f;
    sky.image.width = 32;
    sky.image.height = 16;
    sky.image.pixels.assign(32 * 16, glm::vec3(0.1f));
    sky.image.pixels[5 * 32 + 31] = glm::vec3(500.0f);
    return sky;
}

/// ∫ L dω by a fine grid.
double light_of(const Environment& sky) {
    constexpr int kRows = 2000, kColumns = 2000;
    double sum = 0.0;
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const double y = 1.0 - 2.0 * (row + 0.5) / kRows;
            const double angle = 2.0 * std::numbers::pi * (column + 0.5) / kColumns;
            const double flat = std::sqrt(1.0 - y * y);
            const glm::dvec3 direction(flat * std::cos(angle), y, flat * std::sin(angle));
            sum += double{environment_radiance(sky, glm::vec3(direction)).x};
        }
    }
    return sum * 4.0 * std::numbers::pi / (double{kRows} * kColumns);
}

TEST(PlainSky, SamplesHaveTheLightOfTheImageWithLittleNoise) {
    constexpr int kSamples = 50'000;
    const Environment environment = sky_with_a_sun();
    const PlainSky sky(environment);
    Pcg random(1, 1);
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        const glm::vec3 direction = sky.sample(random);
        const double light = double{sky.radiance(direction).x} / double{sky.pdf(direction)};
        sum += light;
        squares += light * light;
    }
    const double mean = sum / kSamples;
    const double error = std::sqrt((squares / kSamples - mean * mean) / kSamples);
    const double expected = light_of(environment);
    EXPECT_NEAR(mean, expected, 4.0 * error + 1e-3 * expected);
    EXPECT_LT(error, 0.02 * expected);
}

TEST(PlainSky, AConstantSkyIsFoundByChance) {
    Environment environment;
    environment.radiance = glm::vec3(1.0f);
    EXPECT_TRUE(PlainSky(environment).is_empty());
}

}  // namespace
}  // namespace tetralight
