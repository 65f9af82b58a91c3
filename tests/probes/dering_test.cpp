// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/dering.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/sh_minimum.h>
#include "tests/support/random_light.h"

namespace tetralight {
namespace {

IrradianceSh distant_light(glm::vec3 color) {
    return irradiance_from_radiance(
        radiance_from_directional_light(glm::normalize(glm::vec3(2, -1, 2)), color));
}

/// Root mean square over all normals, of the red channel: Parseval's sum.
double rms(const IrradianceSh& sh) {
    double sum = 0.0;
    for (const glm::vec3& c : sh.coefficients) sum += static_cast<double>(c.r) * c.r;
    return std::sqrt(sum / (4.0 * std::numbers::pi));
}

double rms_change(const IrradianceSh& before, const IrradianceSh& after) {
    return rms(before + after * -1.0f) / rms(before);
}

TEST(Dering, LeavesNoNegativeIrradianceAndKeepsTheMean) {
    std::mt19937_64 engine(1);
    const auto directions = test::dense_directions();
    for (int round = 0; round < 300; ++round) {
        const IrradianceSh before = test::ringing_light(engine);
        const IrradianceSh after = dering(before);
        EXPECT_EQ(after.coefficients[0], before.coefficients[0]);
        const glm::dvec3 least = minimum_irradiance(after);
        for (int channel = 0; channel < 3; ++channel) EXPECT_GE(least[channel], 0.0) << round;
        for (const glm::vec3& n : directions) {
            const glm::vec3 e = evaluate_irradiance(after, n);
            const glm::vec3 floor = -1e-6f * after.coefficients[0];
            ASSERT_TRUE(e.r >= floor.r && e.g >= floor.g && e.b >= floor.b) << round;
        }
    }
}

TEST(Dering, IsNoStrongerThanItTakes) {
    std::mt19937_64 engine(2);
    for (int round = 0; round < 300; ++round) {
        const IrradianceSh before = test::ringing_light(engine);
        const glm::dvec3 was = minimum_irradiance(before);
        const glm::dvec3 is = minimum_irradiance(dering(before));
        for (int channel = 0; channel < 3; ++channel) {
            const double mean = 0.2820948 * before.coefficients[0][channel];
            if (was[channel] >= 0.0) continue;
            EXPECT_LE(is[channel], 2e-6 * mean) << round;
        }
    }
}

TEST(Dering, KeepsTheBitsOfWhatDoesNotRing) {
    RadianceSh radiance = constant_radiance({1.0f, 2.0f, 3.0f});
    radiance += radiance_from_directional_light({0, 1, 0}, glm::vec3(2.0f));
    const IrradianceSh light = irradiance_from_radiance(radiance);
    EXPECT_EQ(dering(light), light);
    EXPECT_EQ(dering(IrradianceSh{}), IrradianceSh{});
}

TEST(Dering, TreatsEachChannelAloneSoThatGreyStaysGrey) {
    IrradianceSh light = distant_light(glm::vec3(1.0f));
    light.coefficients[0].b *= 4.0f;  // does not ring
    const IrradianceSh after = dering(light);
    for (int i = 0; i < kShCoefficientCount; ++i) {
        EXPECT_EQ(after.coefficients[i].b, light.coefficients[i].b);
        EXPECT_EQ(after.coefficients[i].r, after.coefficients[i].g);
    }
}

TEST(Dering, ChangesADistantLightHardlyMoreThanTheBestWindow) {
    // E(t) = 1/4 + u t/2 + v (15 t² − 5)/32 is least, for t in [−1, 1], at t = −8u/(15v), and 0
    // there for v²·5/32 − v/4 + u²·2/15 = 0; of all such (u, v) the best changes by 0.1056.
    double best = std::numeric_limits<double>::max();
    for (double u = 0.75; u < std::sqrt(0.75); u += 1e-5) {
        const double v = std::min(1.0, (0.25 + std::sqrt(0.0625 - u * u / 12.0)) * 3.2);
        const double change = (1 - u) * (1 - u) / 12.0 + (1 - v) * (1 - v) * 5.0 / 256.0;
        best = std::min(best, std::sqrt(change / (1.0 / 16 + 1.0 / 12 + 5.0 / 256)));
    }
    EXPECT_NEAR(best, 0.1056, 1e-4);
    const IrradianceSh light = distant_light(glm::vec3(3.0f));
    EXPECT_LE(rms_change(light, dering(light)), 1.03 * best);
}

TEST(Dering, KeepsEveryBlendFromBelowZero) {
    std::mt19937_64 engine(3);
    std::uniform_real_distribution<float> value(0.0f, 1.0f);
    for (int round = 0; round < 1000; ++round) {
        glm::vec4 weights(value(engine), value(engine), value(engine), value(engine));
        weights /= weights.x + weights.y + weights.z + weights.w;
        IrradianceSh blend;
        for (int corner = 0; corner < 4; ++corner) {
            blend += weights[corner] * dering(test::ringing_light(engine));
        }
        EXPECT_GE(minimum_irradiance(blend).r, -1e-6 * blend.coefficients[0].r);
    }
}

TEST(Dering, HoldsInHalfPrecision) {
    std::mt19937_64 engine(4);
    ProbeVolume volume;
    for (int i = 0; i < 1000; ++i) {
        volume.irradiance.push_back(dering(test::ringing_light(engine)));
    }
    make_compact_probes(volume);
    for (const CompactProbe& probe : volume.compact) {
        const IrradianceSh sh = compact_irradiance(probe, volume.info.compact_scale);
        EXPECT_GE(minimum_irradiance(sh).r, -1e-3 * sh.coefficients[0].r);
    }
}

TEST(Dering, LeavesTheMeanAloneWhereItIsNotPositive) {
    IrradianceSh light;
    light.coefficients[0] = {-1.0f, 0.0f, 2.0f};
    light.coefficients[2] = {0.5f, 0.5f, 0.5f};
    const IrradianceSh after = dering(light);
    EXPECT_EQ(after.coefficients[0], light.coefficients[0]);
    EXPECT_EQ(after.coefficients[2], glm::vec3(0.0f, 0.0f, 0.5f));
}

TEST(Dering, HannAndLanczosScaleTheBandsOfEveryLightAlike) {
    std::mt19937_64 engine(5);
    const IrradianceSh light = test::arbitrary_irradiance(engine);
    for (int i = 0; i < kShCoefficientCount; ++i) {
        const double x = std::numbers::pi * std::floor(std::sqrt(i)) / 3.0;
        const double hann = 0.5 * (1.0 + std::cos(x)), lanczos = i == 0 ? 1.0 : std::sin(x) / x;
        const float before = light.coefficients[i].g;
        EXPECT_FLOAT_EQ(dering(light, DeringWindow::Hann).coefficients[i].g,
                        static_cast<float>(hann * before));
        EXPECT_FLOAT_EQ(dering(light, DeringWindow::Lanczos).coefficients[i].g,
                        static_cast<float>(lanczos * before));
    }
}

}  // namespace
}  // namespace tetralight
