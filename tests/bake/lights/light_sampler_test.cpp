// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/light_sampler.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/base/error_text.h>
#include "tests/support/chi_square.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

constexpr double kPi = std::numbers::pi;

TraceScene trace_scene(const Scene& scene) {
    auto result = TraceScene::make_static(scene);
    EXPECT_TRUE(result) << error_text(result.error());
    return std::move(*result);
}

/// A room whose walls shine unevenly, by a texture of four grey levels.
Scene shining_room() {
    Scene scene;
    Texture texture;
    texture.image = {
        2,
        2,
        {{255, 255, 255, 255}, {128, 128, 128, 255}, {60, 60, 60, 255}, {200, 200, 200, 255}}};
    scene.textures.push_back(texture);
    Material walls = test::diffuse(glm::vec3(0.5f), {1, 2, 3});
    walls.emission_texture.texture = 0;
    test::add_box(scene, walls, test::Facing::Inward, {-1, -2, -1}, {2, 1, 1});
    return scene;
}

/// Density with which a direction from a shading point is sampled.
float pdf(const LightSampler& light_sampler, const TraceScene& scene,
          const ShadingPoint& shading_point, glm::vec3 direction) {
    const auto hit = scene.intersect({shading_point.position, direction});
    return hit ? light_sampler.pdf(shading_point, *hit) : light_sampler.pdf(direction);
}

TEST(EmissiveTriangles, PdfIntegratesToOneInARoomOfThem) {
    const Scene scene = shining_room();
    const TraceScene trace = trace_scene(scene);
    const LightSampler light_sampler(scene, trace);
    const ShadingPoint shading_point{{0.3f, -0.2f, 0.1f}};
    constexpr uint32_t kCount = 200000;
    double sum = 0.0;
    for (uint32_t i = 0; i < kCount; ++i) {
        sum += pdf(light_sampler, trace, shading_point, spherical_fibonacci(i, kCount));
    }
    EXPECT_NEAR(sum * 4.0 * kPi / kCount, 1.0, 5e-3);
}

TEST(EmissiveTriangles, DirectionsAreSampledWithTheirPdf) {
    const Scene scene = shining_room();
    const TraceScene trace = trace_scene(scene);
    const LightSampler light_sampler(scene, trace);
    const ShadingPoint shading_point{{0.3f, -0.2f, 0.1f}};
    constexpr uint32_t kDraws = 50000, kProbes = 400000;
    std::vector<int> observed(test::kDirectionBins, 0);
    std::vector<double> expected(test::kDirectionBins, 0.0);
    for (uint32_t i = 0; i < kProbes; ++i) {
        const glm::vec3 d = spherical_fibonacci(i, kProbes);
        expected[test::direction_bin(d)] +=
            pdf(light_sampler, trace, shading_point, d) * 4.0 * kPi / kProbes * kDraws;
    }
    for (uint32_t i = 0; i < kDraws; ++i) {
        Sampler sampler(i, 0);
        const LightSample sample =
            light_sampler.sample(LightKind::Triangle, shading_point, sampler);
        ++observed[test::direction_bin(sample.to_light)];
        EXPECT_NEAR(sample.pdf / pdf(light_sampler, trace, shading_point, sample.to_light), 1.0,
                    0.02);
    }
    EXPECT_TRUE(test::has_frequencies(observed, expected));
}

TEST(EmissiveTriangles, AreEmptyWithoutEmission) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1.0f);
    const TraceScene trace = trace_scene(scene);
    const LightSampler light_sampler(scene, trace);
    for (const LightKind kind :
         {LightKind::Directional, LightKind::Local, LightKind::Triangle, LightKind::Sky}) {
        EXPECT_FALSE(light_sampler.has(kind));
    }
    EXPECT_EQ(pdf(light_sampler, trace, {{0, 1, 0}}, {0, -1, 0}), 0.0f);
}

TEST(EmissiveTriangles, IncludeUnlitSurfacesButNotExcludedEmission) {
    Material unlit = test::diffuse(glm::vec3(0.48f));
    unlit.is_unlit = true;
    for (const bool is_baked : {false, true}) {
        Scene scene;
        unlit.bakes_emission = is_baked;
        test::add_floor(scene, unlit, 1.0f);
        const TraceScene trace = trace_scene(scene);
        const LightSampler light_sampler(scene, trace);
        EXPECT_EQ(light_sampler.has(LightKind::Triangle), is_baked);
        EXPECT_EQ(pdf(light_sampler, trace, {{0, 1, 0}}, {0, -1, 0}) > 0.0f, is_baked);
        EXPECT_EQ(trace.visible_emission(0, 0, {0.2f, 0.2f}),
                  glm::vec3(is_baked ? 0.48f / 0.96f : 0.0f));
    }
}

TEST(EmissiveTriangles, OnlyDoubleSidedOnesEmitBackwards) {
    for (const bool is_double_sided : {false, true}) {
        Scene scene;
        Material panel = test::diffuse(glm::vec3(0.0f), glm::vec3(1.0f));
        panel.is_double_sided = is_double_sided;
        test::add_floor(scene, panel, 1.0f);
        const TraceScene trace = trace_scene(scene);
        const LightSampler light_sampler(scene, trace);
        Sampler sampler(1, 0);
        const LightSample below = light_sampler.sample(LightKind::Triangle, {{0, -2, 0}}, sampler);
        EXPECT_EQ(below.irradiance.x > 0.0f, is_double_sided);
        EXPECT_GT(light_sampler.sample(LightKind::Triangle, {{0, 2, 0}}, sampler).irradiance.x,
                  0.0f);
    }
}

TEST(EmissiveTriangles, HolesAndGlassEmitByTheirOpacity) {
    // The fraction of rays that stop: half for alpha 0.5, none below the cutoff.
    Scene scene;
    Material glass = test::diffuse(glm::vec3(0.0f), glm::vec3(1.0f));
    glass.alpha_mode = AlphaMode::Blend;
    glass.base_color.a = 0.5f;
    test::add_floor(scene, glass, 1.0f);
    glass.alpha_mode = AlphaMode::Mask;
    glass.alpha_cutoff = 0.6f;
    test::add_floor(scene, glass, 1.0f);
    const TraceScene trace = trace_scene(scene);
    EXPECT_EQ(trace.visible_emission(0, 0, {0.2f, 0.2f}), glm::vec3(0.5f));
    EXPECT_EQ(trace.visible_emission(1, 0, {0.2f, 0.2f}), glm::vec3(0.0f));
}

TEST(PunctualLights, DirectionalLightsAreSampledByTheirIrradiance) {
    // Two suns, one below the horizon of a floor: all draws go to the other.
    std::vector<Light> suns(2);
    suns[0].direction = {0, -1, 0};
    suns[0].intensity = glm::vec3(2.0f);
    suns[1].direction = {0, 1, 0};
    const PunctualLights lights(suns);
    for (uint32_t i = 0; i < 100; ++i) {
        Sampler sampler(3, i);
        const LightSample sample = lights.sample_directional({{0, 0, 0}, {0, 1, 0}}, sampler);
        EXPECT_EQ(sample.irradiance, glm::vec3(2.0f));
    }
    // Without a normal, the mean of the samples is the sum of both.
    glm::dvec3 sum(0.0);
    for (uint32_t i = 0; i < 1024; ++i) {
        Sampler sampler(4, i);
        sum += glm::dvec3(lights.sample_directional({}, sampler).irradiance);
    }
    EXPECT_NEAR(sum.x / 1024.0, 3.0, 0.03);
}

}  // namespace
}  // namespace tetralight
