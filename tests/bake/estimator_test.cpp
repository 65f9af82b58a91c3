// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <tetralight/bake/image/srgb.h>
#include <tetralight/bake/probe_estimator.h>
#include <tetralight/bake/sampling/sampling.h>
#include "tests/support/scenes.h"

// The mean light of probes over many independent estimates.

namespace tetralight {
namespace {

constexpr double kBand0 = 0.28209479177387814;

/// Mean and standard error of each coefficient (red).
struct Measured {
    std::array<double, kShCoefficientCount> mean{};
    std::array<double, kShCoefficientCount> error{};
};

Measured measure(const Scene& scene, const glm::dvec3& position, const PathSettings& settings,
                 uint32_t directions = 256, uint32_t trials = 64) {
    const auto trace_scene = TraceScene::make_static(scene);
    EXPECT_TRUE(trace_scene);
    const PathTracer tracer(scene, *trace_scene, settings);
    const DirectionSet set(directions);
    std::array<double, kShCoefficientCount> sum{}, squares{};
    for (uint32_t trial = 0; trial < trials; ++trial) {
        const ProbeEstimate probe = estimate_probe(tracer, trace_scene->render_from_world(position),
                                                   probe_key(trial, position), set);
        for (size_t i = 0; i < sum.size(); ++i) {
            const double value = probe.radiance.coefficients[i].x;
            sum[i] += value;
            squares[i] += value * value;
        }
    }
    Measured result;
    for (size_t i = 0; i < sum.size(); ++i) {
        result.mean[i] = sum[i] / trials;
        const double variance = squares[i] / trials - result.mean[i] * result.mean[i];
        result.error[i] = std::sqrt(std::max(0.0, variance) / (trials - 1));
    }
    return result;
}

/// Four standard errors of the difference: 18 comparisons of one trial each.
void expect_same_mean(const Measured& a, const Measured& b) {
    for (size_t i = 0; i < a.mean.size(); ++i) {
        EXPECT_NEAR(a.mean[i], b.mean[i], 4.0 * std::hypot(a.error[i], b.error[i]) + 1e-5) << i;
    }
}

// --- The strategies agree ------------------------------------------------------------------------

/// A room with a window onto a sky with a sun in its image, screens of each kind, one that is not
/// to be baked, and a solid.
Scene room_of_screens() {
    Scene scene;
    Texture screen;
    screen.image = {2, 2, {{255, 0, 0, 255}, {90, 9, 9, 80}, {200, 0, 0, 255}, {255, 0, 9, 0}}};
    scene.textures.push_back(screen);
    test::add_floor(scene, test::diffuse(glm::vec3(0.7f)), 3.0f);
    test::add_quad(scene, test::diffuse(glm::vec3(0.5f)), {-3, 0, -3}, {6, 0, 0}, {0, 4, 0});
    Material shining = test::diffuse(glm::vec3(0.4f), {4, 2, 1});
    shining.emission_texture.texture = 0;
    test::add_quad(scene, shining, {-1, 1, -2.9f}, {1, 0, 0}, {0, 1, 0});
    shining.base_color_texture.texture = 0;
    shining.alpha_mode = AlphaMode::Blend;
    test::add_quad(scene, shining, {0.5f, 1, -2.5f}, {1, 0, 0}, {0, 1, 0});
    shining.alpha_mode = AlphaMode::Mask;
    shining.is_double_sided = true;
    test::add_quad(scene, shining, {2.0f, 0.5f, 0}, {0, 0, 1}, {0, 1, 0});
    Material unlit = test::diffuse(glm::vec3(0.7f));
    unlit.base_color_texture.texture = 0;
    unlit.is_unlit = true;
    test::add_quad(scene, unlit, {-2, 0.5f, -1.5f}, {0, 1, 0}, {1, 0, 0});
    Material gated = test::diffuse(glm::vec3(0.5f), glm::vec3(100.0f));
    gated.bakes_emission = false;
    test::add_quad(scene, gated, {-2, 0.1f, 1}, {0, 0, 1}, {1, 0, 0});
    test::add_box(scene, test::diffuse({0.8f, 0.3f, 0.3f}), test::Facing::Outward, {-1, 0, -1},
                  {0, 0.7f, 0});
    scene.environment.radiance = glm::vec3(1.0f);
    scene.environment.image = {16, 8, std::vector<glm::vec3>(128, glm::vec3(0.2f))};
    scene.environment.image.pixels[2 * 16 + 9] = glm::vec3(60.0f);
    return scene;
}

TEST(Estimator, LightAndBsdfSamplingHaveTheSameMean) {
    const Scene scene = room_of_screens();
    for (const uint32_t bounces : {0u, 1u, 4u}) {
        const glm::dvec3 position(0.6, 1.2, 0.4);
        const Measured directions =
            measure(scene, position, {bounces, 0.0f, LightStrategy::BsdfOnly}, 4096);
        const Measured emitters =
            measure(scene, position, {bounces, 0.0f, LightStrategy::LightOnly}, 4096);
        const Measured both = measure(scene, position, {bounces, 0.0f, LightStrategy::Mis}, 4096);
        expect_same_mean(directions, emitters);
        expect_same_mean(directions, both);
        EXPECT_LT(both.error[0], emitters.error[0]);
    }
}

TEST(Estimator, EstimatesOfFewSamplesHaveTheMeanOfMany) {
    const Scene scene = room_of_screens();
    const glm::dvec3 position(0.6, 1.2, 0.4);
    const Measured many = measure(scene, position, {4}, 1024);
    expect_same_mean(measure(scene, position, {4}, 16, 4096), many);
    expect_same_mean(measure(scene, position, {4}, 1, 65536), many);
}

TEST(Estimator, ManySampledLightsHaveTheSumOfTheirMeans) {
    // Light is additive: a scene of four lamps is the sum of four scenes.
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.7f)), 3.0f);
    Measured sum;
    for (int i = 0; i < 4; ++i) {
        const float x = static_cast<float>(i) - 1.5f;
        Scene alone = scene;
        alone.lights.clear();
        Light& lamp = test::add_light(alone, static_cast<LightType>(1 + i), LightMode::Mixed,
                                      glm::vec3(static_cast<float>(1 + i)));
        lamp.position = {x, 1, 0.5f * x};
        lamp.width = lamp.height = lamp.radius = 0.3f;
        scene.lights.push_back(lamp);
        const Measured one = measure(alone, {0, 1, 0.1}, {1}, 1024);
        for (size_t k = 0; k < sum.mean.size(); ++k) {
            sum.mean[k] += one.mean[k];
            sum.error[k] = std::hypot(sum.error[k], one.error[k]);
        }
    }
    expect_same_mean(measure(scene, {0, 1, 0.1}, {1}, 1024), sum);
}

// --- White furnaces: radiance 1 everywhere when each wall emits what it absorbs ------------------

/// Enough bounces that 2^-30 of the light is left out.
constexpr PathSettings kLongPaths{30};

void expect_radiance_one(const Scene& scene) {
    for (const glm::dvec3& position :
         {glm::dvec3(0.2, 0.1, -0.3), glm::dvec3(0.999, 0.99, -0.98)}) {
        const Measured light = measure(scene, position, kLongPaths);
        EXPECT_NEAR(light.mean[0] * kBand0, 1.0, 4.0 * light.error[0] * kBand0);
        EXPECT_LT(light.error[0] * kBand0, 0.01);
        for (size_t i = 1; i < light.mean.size(); ++i) {
            EXPECT_NEAR(light.mean[i], 0.0, 4.0 * light.error[i]) << i;
        }
    }
}

TEST(Estimator, FurnaceOfTexturedWallsConservesEnergy) {
    // Albedo {a, 0} and emission {1 − a, 1}, filtered alike.
    Scene scene;
    const float absorbed = linear_from_srgb8(188);  // 0.503
    Texture color, emission;
    color.image = {2, 1, {{255, 255, 255, 255}, {0, 0, 0, 255}}};
    emission.image = {2, 1, {{188, 188, 188, 255}, {255, 255, 255, 255}}};
    scene.textures = {color, emission};
    Material walls = test::diffuse(glm::vec3(1.0f - absorbed), glm::vec3(1.0f));
    walls.base_color_texture.texture = 0;
    walls.emission_texture.texture = 1;
    test::add_box(scene, walls, test::Facing::Inward, {-1, -1, -1}, {1, 1, 1});
    expect_radiance_one(scene);
}

TEST(Estimator, FurnaceOfMetalWallsConservesEnergy) {
    // Diffuse reflectivity of a metal: half of its colour times its roughness.
    Scene scene;
    Material walls = test::diffuse(glm::vec3(0.0f), glm::vec3(1.0f - 0.8f * 0.5f * 0.6f));
    walls.base_color = glm::vec4(glm::vec3(0.8f), 1.0f);
    walls.metallic = 1.0f;
    walls.roughness = 0.6f;
    test::add_box(scene, walls, test::Facing::Inward, {-1, -1, -1}, {1, 1, 1});
    expect_radiance_one(scene);
}

TEST(Estimator, FurnaceOfHalfTransparentWallsConservesEnergy) {
    // Behind the walls is a sky of radiance 1.
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    Material walls = test::diffuse(glm::vec3(0.5f), glm::vec3(0.5f));
    walls.base_color.a = 0.5f;
    walls.alpha_mode = AlphaMode::Blend;
    walls.is_double_sided = true;
    test::add_box(scene, walls, test::Facing::Inward, {-1, -1, -1}, {1, 1, 1});
    expect_radiance_one(scene);
}

TEST(Estimator, FurnaceUnderAnImageOfOneColorConservesEnergy) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    scene.environment.image = {4, 2, std::vector<glm::vec3>(8, glm::vec3(1.0f))};
    test::add_box(scene, test::diffuse(glm::vec3(0.5f), glm::vec3(0.5f)), test::Facing::Outward,
                  {-0.5f, -0.5f, -0.5f}, {0.1f, 0, 0});
    expect_radiance_one(scene);
}

// --- Walls keep light out ------------------------------------------------------------------------

TEST(Estimator, SealedRoomBesideABrightOneIsBlack) {
    // Walls that are seen from inside their own room only, or from both sides.
    for (const bool is_double_sided : {false, true}) {
        Scene scene;
        scene.environment.radiance = glm::vec3(3.0f);
        Material bright = test::diffuse(glm::vec3(0.9f), glm::vec3(5.0f));
        Material dark = test::diffuse(glm::vec3(0.9f));
        bright.is_double_sided = dark.is_double_sided = is_double_sided;
        test::add_box(scene, bright, test::Facing::Inward, {0, 0, 0}, {2, 2, 2});
        test::add_box(scene, dark, test::Facing::Inward, {2.01f, 0, 0}, {4, 2, 2});
        test::add_point_light(scene, LightMode::Baked, glm::vec3(50.0f), {1, 1, 1}).radius = 0.2f;
        test::add_sun(scene, LightMode::Baked, glm::vec3(50.0f)).radius = 0.1f;
        for (const double x : {2.0101, 2.1, 3.0, 3.9999}) {
            const Measured light = measure(scene, {x, 1.0, 1.0}, {4}, 512, 8);
            EXPECT_EQ(light.mean, (std::array<double, kShCoefficientCount>{})) << x;
        }
    }
}

// --- Baked lights, multipliers, clamp ------------------------------------------------------------

TEST(Estimator, RoofOverHalfOfAWideSunHalvesIt) {
    Scene scene;
    test::add_quad(scene, test::diffuse(glm::vec3(0.0f)), {0, 5, -50}, {0, 0, 100}, {50, 0, 0});
    scene.materials[0].is_double_sided = true;
    Light& sun = test::add_sun(scene, LightMode::Baked, glm::vec3(1.0f));
    sun.radius = 0.1f;
    // 256 shadow rays, whose Sobol points the edge misses by a few in the hundred.
    const Measured light = measure(scene, {0, 0, 0}, {0}, 1024);
    EXPECT_NEAR(light.mean[0] / kBand0, 0.5, 0.01);
    EXPECT_LT(light.error[0] * 8.0 / kBand0, 0.02);
}

TEST(Estimator, BlendPanelDimsTheDirectLightOfOneProbe) {
    // 256 shadow rays an estimate of 1024 directions: σ = √(0.4 · 0.6 / 256) = 0.031.
    Scene scene;
    Material glass = test::diffuse(glm::vec3(0.0f));
    glass.base_color.a = 0.6f;
    glass.alpha_mode = AlphaMode::Blend;
    test::add_floor(scene, glass, 10.0f, 3.0f);
    test::add_sun(scene, LightMode::Baked, glm::vec3(1.0f));
    const Measured light = measure(scene, {0.3, 0, 0.1}, {0}, 1024);
    EXPECT_NEAR(light.mean[0] / kBand0, 0.4, 4 * 0.031 / 8);
    EXPECT_LT(light.error[0] * 8.0 / kBand0, 1.5 * 0.031);
}

TEST(Estimator, IndirectMultiplierScalesTheBounceOnly) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 5.0f);
    Light& lamp = test::add_point_light(scene, LightMode::Mixed, glm::vec3(9.0f), {0, 2, 0});
    const Measured once = measure(scene, {0, 1, 0.2}, {4}, 64, 1);
    lamp.indirect_multiplier = 3.0f;
    const Measured thrice = measure(scene, {0, 1, 0.2}, {4}, 64, 1);
    for (size_t i = 0; i < once.mean.size(); ++i) {
        EXPECT_NEAR(thrice.mean[i], 3.0 * once.mean[i], 1e-5 * thrice.mean[0]);
    }
    lamp.indirect_multiplier = 0.0f;
    EXPECT_EQ(measure(scene, {0, 1, 0.2}, {4}, 64, 1).mean[0], 0.0);
    lamp.mode = LightMode::Baked;
    const Measured direct = measure(scene, {0, 1, 0.2}, {4}, 64, 1);
    EXPECT_NEAR(direct.mean[0] / kBand0, 9.0 / 1.04, 1e-4);
}

TEST(Estimator, RealtimeLightsAreNotBaked) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 5.0f);
    test::add_sun(scene, LightMode::Realtime, glm::vec3(9.0f)).radius = 0.1f;
    for (const LightType type :
         {LightType::Point, LightType::Spot, LightType::Rectangle, LightType::Disc}) {
        Light& lamp = test::add_light(scene, type, LightMode::Realtime, glm::vec3(9.0f));
        lamp.position = {0, 2, 0};
        lamp.width = lamp.height = lamp.radius = 0.3f;
    }
    const Measured light = measure(scene, {0, 1, 0.2}, {4}, 64, 1);
    EXPECT_EQ(light.mean, (std::array<double, kShCoefficientCount>{}));
}

TEST(Estimator, ClampDarkensReflectedLightOnly) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f), glm::vec3(7.0f)), 1000.0f);
    test::add_sun(scene, LightMode::Mixed, glm::vec3(1000.0f));
    const auto trace_scene = TraceScene::make_static(scene);
    const PathTracer tracer(scene, *trace_scene, {4, 2.0f});
    const PathSample sample = tracer.trace({{0, 1, 0}, {0, -1, 0}}, Sampler(1, 0));
    EXPECT_FLOAT_EQ(sample.radiance.x, 9.0f);
}

TEST(Estimator, LightStaysFiniteInsideAnEmitter) {
    Scene scene = room_of_screens();
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(9.0f), {0, 0, 1});  // in the floor
    test::add_point_light(scene, LightMode::Baked, glm::vec3(9.0f), {1, 1, 1});
    for (const glm::dvec3& p :
         {glm::dvec3(0, 0, 1), glm::dvec3(1, 1, 1), glm::dvec3(-1, 1, -2.9)}) {
        for (const double value : measure(scene, p, {4}, 256, 4).mean) {
            EXPECT_TRUE(std::isfinite(value));
        }
    }
}

}  // namespace
}  // namespace tetralight
