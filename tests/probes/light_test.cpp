// SPDX-License-Identifier: Apache-2.0
#include "probes/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace tetralight {
namespace {

Light make_light(LightType type) {
    Light light;
    light.type = type;
    light.intensity = {2.0f, 4.0f, 8.0f};
    light.direction = {0.0f, -1.0f, 0.0f};
    return light;
}

TEST(Illuminate, DirectionalLightIsTheSameEverywhere) {
    const Illumination arriving = illuminate(make_light(LightType::Directional), {5, 6, 7});
    EXPECT_EQ(arriving.irradiance, glm::vec3(2.0f, 4.0f, 8.0f));
    EXPECT_EQ(arriving.to_light, glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_TRUE(std::isinf(arriving.distance));
}

TEST(Illuminate, PointLightFallsWithTheSquareOfTheDistance) {
    const Illumination arriving = illuminate(make_light(LightType::Point), {0, -2, 0});
    EXPECT_FLOAT_EQ(arriving.irradiance.x, 2.0f / 4.0f);  // candela / m²
    EXPECT_EQ(arriving.to_light, glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_FLOAT_EQ(arriving.distance, 2.0f);
}

TEST(Illuminate, RangeTakesTheLightToZero) {
    Light light = make_light(LightType::Point);
    light.range = 4.0f;
    // sat(1 − (2/4)⁴) / 2² = 0.9375 / 4
    EXPECT_FLOAT_EQ(illuminate(light, {0, -2, 0}).irradiance.x, 2.0f * 0.9375f / 4.0f);
    EXPECT_EQ(illuminate(light, {0, -4, 0}).irradiance, glm::vec3(0.0f));
    EXPECT_EQ(illuminate(light, {0, -9, 0}).irradiance, glm::vec3(0.0f));
}

TEST(Illuminate, SpotConeIsASquaredRampBetweenCosines) {
    Light light = make_light(LightType::Spot);
    light.cos_inner_cone = 0.9f;
    light.cos_outer_cone = 0.5f;
    const float cosine = 0.7f;  // half way: (0.7 − 0.5) / (0.9 − 0.5) = 1/2, squared 1/4
    const float sine = std::sqrt(1.0f - cosine * cosine);
    EXPECT_NEAR(illuminate(light, {sine, -cosine, 0.0f}).irradiance.x, 2.0f / 4.0f, 1e-5f);
    EXPECT_FLOAT_EQ(illuminate(light, {0, -1, 0}).irradiance.x, 2.0f);
    EXPECT_EQ(illuminate(light, {1, 0, 0}).irradiance, glm::vec3(0.0f));
}

TEST(Illuminate, APositionInTheLightItselfIsDark) {
    EXPECT_EQ(illuminate(make_light(LightType::Point), {0, 0, 0}).irradiance, glm::vec3(0.0f));
}

}  // namespace
}  // namespace tetralight
