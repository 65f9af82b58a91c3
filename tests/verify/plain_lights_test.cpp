// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/plain_lights.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

constexpr int kSamples = 100'000;

/// Mean and standard error of the irradiance of a surface with a normal.
struct Mean {
    double mean = 0.0, error = 0.0;
};

Mean mean_of(const std::function<double(Pcg&)>& draw) {
    Pcg random(3, 4);
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        const double value = draw(random);
        sum += value;
        squares += value * value;
    }
    const double mean = sum / kSamples;
    return {mean, std::sqrt((squares / kSamples - mean * mean) / kSamples)};
}

Mean irradiance_of(const Light& light, glm::vec3 position, glm::vec3 normal) {
    return mean_of([&](Pcg& random) {
        const PlainLightSample sample = sample_plain_light(light, position, random);
        return double{sample.irradiance.x} *
               std::max(0.0, double{glm::dot(normal, sample.to_light)});
    });
}

void expect_near(const Mean& actual, double expected) {
    EXPECT_NEAR(actual.mean, expected, 5.0 * actual.error + 1e-5 * expected);
    EXPECT_LT(actual.error, 0.01 * expected);
}

Light light_of(LightType type) {
    Light light;
    light.type = type;
    light.intensity = glm::vec3(3.0f);
    light.position = {0.0f, 2.0f, 0.0f};
    light.direction = {0.0f, -1.0f, 0.0f};
    return light;
}

/// A facing surface gets the light's irradiance, whatever its size in the sky.
TEST(PlainLights, ASunGivesItsIrradiance) {
    Light sun = light_of(LightType::Directional);
    for (const float radius : {0.0f, 0.3f}) {
        sun.radius = radius;
        expect_near(irradiance_of(sun, glm::vec3(0.0f), {0, 1, 0}), 3.0);
    }
}

TEST(PlainLights, ASphereGivesTheLightOfItsCentre) {
    Light lamp = light_of(LightType::Point);
    for (const float radius : {0.0f, 0.5f, 1.5f}) {
        lamp.radius = radius;
        expect_near(irradiance_of(lamp, glm::vec3(0.0f), {0, 1, 0}), 3.0 / 4.0);
    }
}

/// E = I / (r² + d²) on the axis of a disc of radius r.
TEST(PlainLights, ADiscOnItsAxisHasAClosedForm) {
    Light disc = light_of(LightType::Disc);
    disc.radius = 1.0f;
    expect_near(irradiance_of(disc, glm::vec3(0.0f), {0, 1, 0}), 3.0 / (1.0 + 4.0));
}

/// The form factor of a parallel rectangle with one corner above the surface (Howell, A Catalog of
/// Radiation Heat Transfer Configuration Factors, B-3); a surface below the centre sees four.
TEST(PlainLights, ARectangleHasAClosedForm) {
    Light panel = light_of(LightType::Rectangle);
    panel.width = 2.0f;
    panel.height = 3.0f;
    const double a = 1.0 / 2.0, b = 1.5 / 2.0;
    const double rootA = std::sqrt(1.0 + a * a), rootB = std::sqrt(1.0 + b * b);
    const double quarter = (a / rootA * std::atan(b / rootA) + b / rootB * std::atan(a / rootB)) /
                           (2.0 * std::numbers::pi);
    const double radiance = 3.0 / 6.0;  // intensity over area
    expect_near(irradiance_of(panel, glm::vec3(0.0f), {0, 1, 0}),
                std::numbers::pi * radiance * 4.0 * quarter);
}

TEST(PlainLights, LightsEndWithTheirShape) {
    Light lamp = light_of(LightType::Point);
    lamp.radius = 0.5f;
    Pcg random(1, 1);
    for (int i = 0; i < 100; ++i) {
        const PlainLightSample sample = sample_plain_light(lamp, glm::vec3(0.0f), random);
        const glm::vec3 end = sample.distance * sample.to_light;
        EXPECT_NEAR(glm::distance(end, lamp.position), 0.5f, 1e-4f);
    }
}

TEST(PlainLights, DrawsOfManyLightsHaveTheSumOfTheirLight) {
    std::vector<Light> lights;
    double expected = 0.0;
    for (int i = 0; i < 11; ++i) {
        Light light = light_of(LightType::Point);
        light.position.y = 1.0f + static_cast<float>(i);
        expected += 3.0 / double{light.position.y * light.position.y};
        lights.push_back(light);
    }
    const PlainLights all(lights);
    EXPECT_EQ(all.draw_count(), 4u);
    expect_near(mean_of([&](Pcg& random) {
                    double sum = 0.0;
                    for (uint32_t i = 0; i < all.draw_count(); ++i)
                        sum += double{all.sample(i, glm::vec3(0.0f), random).irradiance.x};
                    return sum;
                }),
                expected);
}

/// The mean of 1 / density is the solid angle of the emitters: here half of the sphere.
TEST(PlainLights, EmittersAreSampledWithTheirDensity) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(1.0f)), 2.0f);
    const auto traced = TraceScene::make_static(scene);
    ASSERT_TRUE(traced);
    const PlainEmitters emitters(scene, *traced);
    const glm::vec3 eye = traced->render_from_world({0.0, 1.0, 0.0});
    const Mean solid_angle = mean_of([&](Pcg& random) {
        const auto choice = emitters.sample(eye, random);
        const auto surface = traced->intersect({eye, choice.direction});
        return surface ? 1.0 / double{emitters.pdf(eye, choice.direction, *surface)} : 0.0;
    });
    // Of a square of side 2a at distance 1 from its centre: 4 asin(a² / (1 + a²)).
    expect_near(solid_angle, 4.0 * std::asin(4.0 / 5.0));
}

}  // namespace
}  // namespace tetralight
