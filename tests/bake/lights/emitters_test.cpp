// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/emitters.h>

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

TraceScene traced(const Scene& scene) {
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

/// Density with which a direction from a shading point is drawn.
float pdf(const Emitters& emitters, const TraceScene& scene, const ShadingPoint& shading_point,
          glm::vec3 direction) {
    const auto met = scene.intersect({shading_point.position, direction});
    return met ? emitters.pdf(shading_point, *met) : emitters.pdf(direction);
}

TEST(EmissiveTriangles, PdfIntegratesToOneInARoomOfThem) {
    const Scene scene = shining_room();
    const TraceScene trace = traced(scene);
    const Emitters emitters(scene, trace);
    const ShadingPoint shading_point{{0.3f, -0.2f, 0.1f}};
    constexpr uint32_t kCount = 200000;
    double sum = 0.0;
    for (uint32_t i = 0; i < kCount; ++i) {
        sum += pdf(emitters, trace, shading_point, spherical_fibonacci(i, kCount));
    }
    EXPECT_NEAR(sum * 4.0 * kPi / kCount, 1.0, 5e-3);
}

TEST(EmissiveTriangles, DirectionsAreDrawnAsOftenAsThePdfSays) {
    const Scene scene = shining_room();
    const TraceScene trace = traced(scene);
    const Emitters emitters(scene, trace);
    const ShadingPoint shading_point{{0.3f, -0.2f, 0.1f}};
    constexpr uint32_t kDraws = 50000, kProbes = 400000;
    std::vector<int> observed(test::kDirectionBins, 0);
    std::vector<double> expected(test::kDirectionBins, 0.0);
    for (uint32_t i = 0; i < kProbes; ++i) {
        const glm::vec3 d = spherical_fibonacci(i, kProbes);
        expected[test::direction_bin(d)] +=
            pdf(emitters, trace, shading_point, d) * 4.0 * kPi / kProbes * kDraws;
    }
    for (uint32_t i = 0; i < kDraws; ++i) {
        Sampler numbers(i, 0);
        const LightSample sample = emitters.sample(EmitterKind::Triangle, shading_point, numbers);
        ++observed[test::direction_bin(sample.to_light)];
        EXPECT_NEAR(sample.pdf / pdf(emitters, trace, shading_point, sample.to_light), 1.0, 0.02);
    }
    EXPECT_TRUE(test::has_frequencies(observed, expected));
}

TEST(EmissiveTriangles, AreEmptyWithoutEmission) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1.0f);
    const TraceScene trace = traced(scene);
    const Emitters emitters(scene, trace);
    for (const EmitterKind kind :
         {EmitterKind::Sun, EmitterKind::PunctualLight, EmitterKind::Triangle, EmitterKind::Sky}) {
        EXPECT_FALSE(emitters.has(kind));
    }
    EXPECT_EQ(pdf(emitters, trace, {{0, 1, 0}}, {0, -1, 0}), 0.0f);
}

TEST(EmissiveTriangles, UnlitSurfacesAreAmongThemAndThoseThatAreNotBakedAreNot) {
    Material unlit = test::diffuse(glm::vec3(0.48f));
    unlit.is_unlit = true;
    for (const bool is_baked : {false, true}) {
        Scene scene;
        unlit.bakes_emission = is_baked;
        test::add_floor(scene, unlit, 1.0f);
        const TraceScene trace = traced(scene);
        const Emitters emitters(scene, trace);
        EXPECT_EQ(emitters.has(EmitterKind::Triangle), is_baked);
        EXPECT_EQ(pdf(emitters, trace, {{0, 1, 0}}, {0, -1, 0}) > 0.0f, is_baked);
        EXPECT_EQ(trace.visible_emission(0, 0, {0.2f, 0.2f}),
                  glm::vec3(is_baked ? 0.48f / 0.96f : 0.0f));
    }
}

TEST(EmissiveTriangles, OnlyDoubleSidedOnesShineBackwards) {
    for (const bool is_double_sided : {false, true}) {
        Scene scene;
        Material panel = test::diffuse(glm::vec3(0.0f), glm::vec3(1.0f));
        panel.is_double_sided = is_double_sided;
        test::add_floor(scene, panel, 1.0f);
        const TraceScene trace = traced(scene);
        const Emitters emitters(scene, trace);
        Sampler numbers(1, 0);
        const LightSample below = emitters.sample(EmitterKind::Triangle, {{0, -2, 0}}, numbers);
        EXPECT_EQ(below.irradiance.x > 0.0f, is_double_sided);
        EXPECT_GT(emitters.sample(EmitterKind::Triangle, {{0, 2, 0}}, numbers).irradiance.x, 0.0f);
    }
}

TEST(EmissiveTriangles, HolesAndGlassShineByTheirShare) {
    // The share of rays that stop: half for alpha 0.5, none below the cutoff.
    Scene scene;
    Material glass = test::diffuse(glm::vec3(0.0f), glm::vec3(1.0f));
    glass.alpha_mode = AlphaMode::Blend;
    glass.base_color.a = 0.5f;
    test::add_floor(scene, glass, 1.0f);
    glass.alpha_mode = AlphaMode::Mask;
    glass.alpha_cutoff = 0.6f;
    test::add_floor(scene, glass, 1.0f);
    const TraceScene trace = traced(scene);
    EXPECT_EQ(trace.visible_emission(0, 0, {0.2f, 0.2f}), glm::vec3(0.5f));
    EXPECT_EQ(trace.visible_emission(1, 0, {0.2f, 0.2f}), glm::vec3(0.0f));
}

TEST(PunctualLights, SunsAreDrawnByWhatTheyGive) {
    // Two suns, one below the horizon of a floor: all draws go to the other.
    std::vector<Light> suns(2);
    suns[0].direction = {0, -1, 0};
    suns[0].intensity = glm::vec3(2.0f);
    suns[1].direction = {0, 1, 0};
    const PunctualLights lamps(suns);
    for (uint32_t i = 0; i < 100; ++i) {
        Sampler numbers(3, i);
        const LightSample sample = lamps.sample_sun({{0, 0, 0}, {0, 1, 0}}, numbers);
        EXPECT_EQ(sample.irradiance, glm::vec3(2.0f));
    }
    // Seen from everywhere the mean of the draws is the sum of both.
    glm::dvec3 sum(0.0);
    for (uint32_t i = 0; i < 1024; ++i) {
        Sampler numbers(4, i);
        sum += glm::dvec3(lamps.sample_sun({}, numbers).irradiance);
    }
    EXPECT_NEAR(sum.x / 1024.0, 3.0, 0.03);
}

}  // namespace
}  // namespace tetralight
