// SPDX-License-Identifier: Apache-2.0
#include "pipeline/probe_balls.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

constexpr glm::vec3 kAhead(0.0f, 0.0f, -1.0f);

TEST(ProbeBalls, ShowTheLightOfTheirProbe) {
    ProbeVolume volume = test::make_lit_volume({{0, 0, 0}, {1e6, 0, 0}});
    volume.irradiance[0] = irradiance_from_radiance(constant_radiance({1, 2, 3}));
    volume.irradiance[1] = irradiance_from_radiance(constant_radiance({4, 5, 6}));
    const auto balls = ProbeBalls::make(volume.view(), 0.5f);
    ASSERT_TRUE(balls);
    for (size_t i = 0; i < 2; ++i) {
        const auto seen = balls->shade(volume.exact_positions[i] + glm::dvec3(0, 0, 3), kAhead);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->distance, 2.5f, 1e-4f);
        // Under constant radiance a white ball shows just that.
        const float dc = volume.irradiance[i].coefficients[0].x;
        EXPECT_NEAR(seen->radiance.x, dc * 0.28209479f / std::numbers::pi_v<float>, 1e-4f);
    }
}

TEST(ProbeBalls, AreNowhereElse) {
    const ProbeVolume volume = test::make_lit_volume({{0, 0, 0}});
    const auto balls = ProbeBalls::make(volume.view(), 0.5f);
    ASSERT_TRUE(balls);
    EXPECT_FALSE(balls->shade({0.6, 0, 3}, kAhead));
    EXPECT_FALSE(balls->shade({0, 0, -3}, kAhead));
}

TEST(ProbeBalls, OfUnlitVolumesShowTheAmbientLight) {
    ProbeVolume volume = test::make_lit_volume({{0, 0, 0}});
    volume.irradiance.clear();
    volume.info.ambient = irradiance_from_radiance(constant_radiance(glm::vec3(2.0f)));
    const auto balls = ProbeBalls::make(volume.view(), 0.5f);
    ASSERT_TRUE(balls);
    EXPECT_NEAR(balls->shade({0, 0, 3}, kAhead)->radiance.y, 2.0f, 1e-4f);
}

}  // namespace
}  // namespace tetralight
