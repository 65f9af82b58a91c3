// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/light.h>

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

constexpr LightFalloff kFalloffs[] = {LightFalloff::Gltf, LightFalloff::InverseSquareRange,
                                      LightFalloff::Linear, LightFalloff::Legacy};

Light ranged(LightFalloff falloff, float range) {
    Light light = make_light(LightType::Point);
    light.falloff = falloff;
    light.range = range;
    return light;
}

TEST(Falloff, IsTheDocumentedFormulaHalfWayToTheRange) {
    // x = 1/2 at d = 2: window 1 − x⁴ = 15/16; legacy 1/(1 + 25/4) = 4/29 below its fade.
    EXPECT_FLOAT_EQ(evaluate_falloff(ranged(LightFalloff::Gltf, 4), 2), 15.0f / 16 / 4);
    EXPECT_FLOAT_EQ(evaluate_falloff(ranged(LightFalloff::InverseSquareRange, 4), 2),
                    15.0f * 15 / 256 / 4);
    EXPECT_FLOAT_EQ(evaluate_falloff(ranged(LightFalloff::Linear, 4), 2), 0.5f);
    EXPECT_FLOAT_EQ(evaluate_falloff(ranged(LightFalloff::Legacy, 4), 2), 4.0f / 29);
}

TEST(Falloff, LegacyFadesOverTheLastFifthOfItsRange) {
    // x² = 0.82 is the middle of the fade from 0.64 to 1.
    const float distance = std::sqrt(0.82f);
    EXPECT_FLOAT_EQ(evaluate_falloff(ranged(LightFalloff::Legacy, 1), distance),
                    0.5f / (1 + 25 * 0.82f));
}

TEST(Falloff, NeverJumps) {
    // No step of 1/1000 of the range changes any formula by more than 1 % of what it is at x = 0.1,
    // nor where pieces meet (x = 0.8) or end (x = 1). The steepest, 1/d², falls by 2 % a step
    // there.
    for (const LightFalloff falloff : kFalloffs) {
        const Light light = ranged(falloff, 8);
        const float largest = evaluate_falloff(light, 0.8f);
        float last = largest;
        for (int i = 101; i <= 1100; ++i) {
            const float value = evaluate_falloff(light, 0.008f * static_cast<float>(i));
            EXPECT_LE(value, last);
            EXPECT_LT(last - value, 0.025f * largest) << i;
            last = value;
        }
        EXPECT_EQ(last, 0.0f);
    }
}

TEST(Falloff, IsZeroFromTheRangeOn) {
    for (const LightFalloff falloff : kFalloffs) {
        EXPECT_GT(evaluate_falloff(ranged(falloff, 3), 2.99f), 0.0f);
        EXPECT_NEAR(evaluate_falloff(ranged(falloff, 3), 3.0f), 0.0f, 1e-6f);
        EXPECT_EQ(evaluate_falloff(ranged(falloff, 3), 30.0f), 0.0f);
    }
}

TEST(Falloff, ScalesWithTheScene) {
    // Twice as large, 1/d² is a quarter as bright; the others keep their value.
    for (const LightFalloff falloff : kFalloffs) {
        const bool is_square = falloff <= LightFalloff::InverseSquareRange;
        EXPECT_FLOAT_EQ(evaluate_falloff(ranged(falloff, 6), 4) * (is_square ? 4.0f : 1.0f),
                        evaluate_falloff(ranged(falloff, 3), 2));
    }
}

TEST(Falloff, WithoutARangeNothingEndsTheLight) {
    EXPECT_FLOAT_EQ(evaluate_falloff(ranged(LightFalloff::Gltf, 0), 100), 1e-4f);
    EXPECT_FLOAT_EQ(evaluate_falloff(ranged(LightFalloff::InverseSquareRange, 0), 100), 1e-4f);
}

TEST(Illuminate, DirectionalLightsHaveNoFalloff) {
    Light sun = ranged(LightFalloff::Linear, 1);
    sun.type = LightType::Directional;
    EXPECT_EQ(evaluate_falloff(sun, 50), 1.0f);
    EXPECT_EQ(illuminate(sun, {0, -50, 0}).irradiance, sun.intensity);
}

Light area_light(LightType type, float size) {
    Light light = make_light(type);
    light.width = light.height = size;
    light.radius = size;
    return light;
}

TEST(Illuminate, AreaLightsAreLambertEmittersFromAfar) {
    for (const LightType type : {LightType::Rectangle, LightType::Disc}) {
        const Light light = area_light(type, 0.1f);
        // 60° off the axis: the cosine is 1/2.
        const glm::vec3 position = 10.0f * glm::vec3(std::sqrt(0.75f), -0.5f, 0.0f);
        EXPECT_NEAR(illuminate(light, position).irradiance.x, 2.0f * 0.5f / 100, 1e-5f);
        EXPECT_NEAR(illuminate(light, {0, -10, 0}).irradiance.x, 2.0f / 100, 1e-5f);
    }
}

TEST(Illuminate, AreaLightsShineFromTheirFrontOnly) {
    for (const LightType type : {LightType::Rectangle, LightType::Disc}) {
        const Light light = area_light(type, 1.0f);
        EXPECT_EQ(illuminate(light, {0, 2, 0}).irradiance, glm::vec3(0.0f));
        EXPECT_EQ(illuminate(light, {2, 0, 0}).irradiance, glm::vec3(0.0f));
    }
}

TEST(Illuminate, OnTheAxisOfADiscIsExact) {
    // Constant radiance L over a cap of half angle θ gives π L sin²θ, with L = I / (π r²) and
    // sin²θ = r² / (r² + d²); as near as one likes.
    const Light light = area_light(LightType::Disc, 2.0f);
    for (const float d : {0.01f, 1.0f, 3.0f}) {
        const float radiance = light.intensity.x / light_area(light);
        const float expected = 3.14159265f * radiance * 4.0f / (4.0f + d * d);
        EXPECT_NEAR(illuminate(light, {0, -d, 0}).irradiance.x, expected, 1e-5f);
    }
}

TEST(Illuminate, AreaLightsFollowTheirFalloffToo) {
    Light light = area_light(LightType::Rectangle, 1.0f);
    light.falloff = LightFalloff::Linear;
    light.range = 4.0f;
    EXPECT_FLOAT_EQ(illuminate(light, {0, -1, 0}).irradiance.x, 2.0f * 0.75f);
    EXPECT_EQ(illuminate(light, {0, -4, 0}).irradiance, glm::vec3(0.0f));
}

TEST(Illuminate, RadiusOfASphereChangesNoIrradiance) {
    // A sphere lights a surface that faces it, and sees all of it, like a point in its centre.
    Light light = make_light(LightType::Point);
    const Illumination point = illuminate(light, {0, -2, 0});
    light.radius = 0.5f;
    EXPECT_EQ(illuminate(light, {0, -2, 0}).irradiance, point.irradiance);
}

TEST(Illuminate, APositionInTheLightItselfIsDark) {
    EXPECT_EQ(illuminate(make_light(LightType::Point), {0, 0, 0}).irradiance, glm::vec3(0.0f));
}

}  // namespace
}  // namespace tetralight
