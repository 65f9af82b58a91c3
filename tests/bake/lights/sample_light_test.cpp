// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/sample_light.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/bake/sampling/sobol.h>
#include <tetralight/bake/sampling/spherical_rectangle.h>
#include "tests/support/chi_square.h"

namespace tetralight {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr uint32_t kCount = 1 << 14;

/// Irradiance (red) of a surface at the origin: the mean over the light's samples.
double irradiance(const Light& light, glm::vec3 normal) {
    double sum = 0.0;
    for (uint32_t i = 0; i < kCount; ++i) {
        const LightSample sample = sample_light(light, glm::vec3(0.0f), owen_sobol2(i, 99));
        sum += sample.irradiance.x * std::max(0.0f, glm::dot(normal, sample.to_light));
    }
    return sum / kCount;
}

/// Of intensity 6 candela, at height `distance` over the origin, shining down.
Light lamp(LightType type, float distance) {
    Light light;
    light.type = type;
    light.intensity = glm::vec3(6.0f);
    light.position = {0, distance, 0};
    light.direction = {0, -1, 0};
    return light;
}

const glm::vec3 kUp(0, 1, 0);

TEST(SampleLight, WithoutRadiusEverySampleIsTheIllumination) {
    for (const LightType type : {LightType::Directional, LightType::Point, LightType::Spot}) {
        const Light light = lamp(type, 2.0f);
        const Illumination expected = illuminate(light, glm::vec3(0.0f));
        const LightSample sample = sample_light(light, glm::vec3(0.0f), {0.3f, 0.7f});
        EXPECT_EQ(sample.irradiance, expected.irradiance);
        EXPECT_LT(glm::distance(sample.to_light, expected.to_light), 1e-6f);
        EXPECT_EQ(sample.is_distant, type == LightType::Directional);
        EXPECT_TRUE(has_hard_shadows(light));
    }
}

TEST(SampleLight, SunOfAnyAngleGivesItsIrradianceHeadOn) {
    for (const float radius : {0.005f, 0.2f, 1.5f}) {
        Light sun = lamp(LightType::Directional, 0.0f);
        sun.radius = radius;
        EXPECT_NEAR(irradiance(sun, kUp), 6.0, 6.0 * 1e-3) << radius;
    }
}

TEST(SampleLight, WideSunAtTheHorizonLightsByWhatIsAboveIt) {
    // Vertical surface under a sun of half angle π/2 overhead: a hemisphere of radiance E/π, of
    // which a quarter of the sphere is before the surface. ∫ cos over that is π/2: E/2.
    Light sun = lamp(LightType::Directional, 0.0f);
    sun.radius = static_cast<float>(kPi / 2);
    EXPECT_NEAR(irradiance(sun, {1, 0, 0}), 3.0, 3.0 * 2e-3);
}

TEST(SampleLight, SphereLightsLikeItsCenter) {
    // π L sin² a with L = I / πr² and sin a = r/d: I/d² (Lambert's sphere).
    for (const float radius : {0.01f, 0.5f, 1.9f}) {
        Light bulb = lamp(LightType::Point, 2.0f);
        bulb.radius = radius;
        EXPECT_NEAR(irradiance(bulb, kUp), 1.5, 1.5e-3) << radius;
        const glm::vec3 slanted = glm::normalize(glm::vec3(0.3f, 1.0f, 0.0f));  // none below it
        if (radius > 1.0f) continue;
        EXPECT_NEAR(irradiance(bulb, slanted), 1.5 * slanted.y, 2e-3);
    }
}

TEST(SampleLight, ShadowRaysEndOnTheSphere) {
    Light bulb = lamp(LightType::Point, 2.0f);
    bulb.radius = 0.5f;
    for (uint32_t i = 0; i < 100; ++i) {
        const LightSample sample = sample_light(bulb, glm::vec3(0.0f), owen_sobol2(i, 1));
        EXPECT_NEAR(glm::distance(sample.target, bulb.position), 0.5f, 1e-4f);
        EXPECT_LT(glm::distance(glm::normalize(sample.target), sample.to_light), 1e-5f);
        EXPECT_LE(glm::length(sample.target), 2.0f);  // its near side
    }
}

TEST(SampleLight, WithinASphereThereIsStillLight) {
    Light bulb = lamp(LightType::Point, 0.5f);
    bulb.radius = 2.0f;
    const double expected = 6.0 / 0.25;
    EXPECT_NEAR(irradiance(bulb, kUp), expected, 1e-3 * expected);
}

TEST(SampleLight, SoftSpotKeepsItsCone) {
    Light spot = lamp(LightType::Spot, 2.0f);
    spot.radius = 0.2f;
    EXPECT_NEAR(irradiance(spot, kUp), 1.5, 1.5e-3);
    EXPECT_EQ(sample_light(spot, {9, 0, 0}, {0.5f, 0.5f}).irradiance, glm::vec3(0.0f));
}

TEST(SampleLight, DiscHasItsFormFactor) {
    // E = π L r² / (r² + d²), L = I / πr²: I / (r² + d²).
    for (const float radius : {0.1f, 1.0f, 4.0f}) {
        Light disc = lamp(LightType::Disc, 2.0f);
        disc.radius = radius;
        const double expected = 6.0 / (radius * radius + 4.0);
        EXPECT_NEAR(irradiance(disc, kUp), expected, 2e-3 * expected) << radius;
    }
}

/// Surface under the middle of a rectangle: four times Howell's B-3 for a corner. E = π L F.
double rectangle_irradiance(double width, double height, double distance) {
    const double a = 0.5 * width / distance, b = 0.5 * height / distance;
    const double sa = std::sqrt(1 + a * a), sb = std::sqrt(1 + b * b);
    const double factor =
        4.0 / (2.0 * kPi) * (a / sa * std::atan(b / sa) + b / sb * std::atan(a / sb));
    return kPi * 6.0 / (width * height) * factor;
}

TEST(SampleLight, RectangleHasItsFormFactor) {
    // By solid angle, and the smallest by area.
    for (const float size : {0.001f, 0.05f, 1.0f, 20.0f}) {
        Light panel = lamp(LightType::Rectangle, 2.0f);
        panel.tangent = {0.6f, 0, 0.8f};
        panel.width = size;
        panel.height = 0.5f * size;
        const double expected = rectangle_irradiance(size, 0.5 * size, 2.0);
        EXPECT_NEAR(irradiance(panel, kUp), expected, 2e-3 * expected) << size;
    }
}

TEST(SampleLight, AreaLightsEmitFromTheirFrontOnly) {
    for (const LightType type : {LightType::Rectangle, LightType::Disc}) {
        Light panel = lamp(type, 2.0f);
        panel.width = panel.height = panel.radius = 1.0f;
        panel.direction = {0, 1, 0};
        EXPECT_EQ(irradiance(panel, kUp), 0.0);
        EXPECT_FALSE(has_hard_shadows(panel));
    }
}

TEST(SampleLight, AreaLightsEndAtTheirRange) {
    for (const LightType type : {LightType::Rectangle, LightType::Disc}) {
        Light panel = lamp(type, 2.0f);
        panel.width = panel.height = panel.radius = 0.5f;
        panel.range = 1.9f;
        EXPECT_EQ(irradiance(panel, kUp), 0.0);
    }
}

TEST(SphericalRectangle, SolidAngleOfACubesFaceIsASixthOfTheSphere) {
    const SphericalRectangle face({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, glm::dvec3(0.0));
    EXPECT_NEAR(face.solid_angle(), 4.0 * kPi / 6.0, 1e-12);
}

TEST(SphericalRectangle, PartsAreSampledByTheirSolidAngle) {
    // Cells of the rectangle are sampled in proportion to their solid angles.
    const glm::dvec3 corner(-0.5, 0.4, 1.0), along(2, 0, 0), across(0, 0, 1.5), eye(0.3, 0.1, -0.2);
    const SphericalRectangle whole(corner, along, across, eye);
    std::array<int, 64> observed{};
    std::array<double, 64> expected{};
    constexpr uint32_t kDraws = 64 * 1000;
    for (int i = 0; i < 64; ++i) {
        const glm::dvec3 cell = corner + along * (i % 8 / 8.0) + across * (i / 8 / 8.0);
        expected[static_cast<size_t>(i)] =
            kDraws * SphericalRectangle(cell, along / 8.0, across / 8.0, eye).solid_angle() /
            whole.solid_angle();
    }
    for (uint32_t i = 0; i < kDraws; ++i) {
        const glm::dvec3 point(whole.sample(Sampler(i, 0).next2()));
        const auto column = std::min(7, static_cast<int>((point.x - corner.x) / 2.0 * 8.0));
        const auto row = std::min(7, static_cast<int>((point.z - corner.z) / 1.5 * 8.0));
        ++observed[static_cast<size_t>(row * 8 + column)];
    }
    EXPECT_TRUE(test::has_frequencies(observed, expected));
}

}  // namespace
}  // namespace tetralight
