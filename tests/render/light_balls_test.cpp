// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/light_balls.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

constexpr glm::vec3 kAhead(0.0f, 0.0f, -1.0f);

LightBall ball(const glm::dvec3& center, glm::vec3 radiance) {
    return {center, 0.5f, irradiance_from_radiance(constant_radiance(radiance))};
}

TEST(LightBalls, ShowTheirLight) {
    const LightBall lit[] = {ball({0, 0, 0}, {1, 2, 3}), ball({1e6, 0, 0}, {4, 5, 6})};
    const auto balls = LightBalls::make(lit);
    ASSERT_TRUE(balls);
    for (int i = 0; i < 2; ++i) {
        const auto seen = balls->shade(lit[i].center + glm::dvec3(0, 0, 3), kAhead);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->distance, 2.5f, 1e-4f);
        // Under constant radiance a white ball shows just that.
        EXPECT_NEAR(seen->radiance.x, 1.0f + 3.0f * static_cast<float>(i), 1e-4f);
    }
}

TEST(LightBalls, AreNowhereElse) {
    const LightBall lit[] = {ball({0, 0, 0}, {1, 1, 1})};
    const auto balls = LightBalls::make(lit);
    ASSERT_TRUE(balls);
    EXPECT_FALSE(balls->shade({0.6, 0, 3}, kAhead));
    EXPECT_FALSE(balls->shade({0, 0, -3}, kAhead));
    EXPECT_FALSE(LightBalls::make({})->find({0, 0, 3}, kAhead));
}

}  // namespace
}  // namespace tetralight
