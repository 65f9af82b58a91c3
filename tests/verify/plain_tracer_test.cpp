// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/plain_tracer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include <tetralight/verify/trace_light.h>
#include "tests/support/scenes.h"

// Light with a closed form. Mean irradiance over all normals is ∫ L dω / 4.

namespace tetralight {
namespace {

constexpr double kPi = std::numbers::pi;

TracedLight light_at(const Scene& scene, const glm::dvec3& position, uint32_t bounces = 1000,
                     uint64_t sample_count = 1 << 16) {
    const auto traced = TraceScene::make_static(scene);
    EXPECT_TRUE(traced);
    const PlainTracer tracer(scene, *traced, {bounces, {}});
    return trace_light(tracer, position, {.sample_count = sample_count});
}

void expect_light(const TracedLight& light, double expected, double largest_error = 0.01) {
    EXPECT_NEAR(light.mean.x, expected, 4.0 * light.error.x + 1e-4 * expected);
    EXPECT_LE(light.error.x, largest_error * expected);
}

TEST(PlainTracer, AConstantSkyGivesPi) {
    Scene scene;
    scene.environment.radiance = {1.0f, 2.0f, 0.5f};
    const TracedLight light = light_at(scene, {1.0, 2.0, 3.0});
    EXPECT_NEAR(light.mean.x, kPi, 1e-5);
    EXPECT_NEAR(light.mean.y, 2.0 * kPi, 1e-5);
    EXPECT_NEAR(light.mean.z, 0.5 * kPi, 1e-5);
    EXPECT_NEAR(evaluate_irradiance(light.irradiance, {0, 1, 0}).x, kPi, 0.05);
}

/// A white box in a constant sky shows the sky: it does not change the light around it.
TEST(PlainTracer, AWhiteBoxDoesNotChangeAFurnace) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_box(scene, test::diffuse(glm::vec3(0.96f)), test::Facing::Outward, {-1, -1, -1},
                  {1, 1, 1});
    scene.materials[0].base_color = glm::vec4(1.0f);
    const TracedLight light = light_at(scene, {0.0, 1.5, 0.0});
    // It absorbs 4 %: between full light and that of a box without second reflections.
    EXPECT_LT(light.mean.x, kPi);
    EXPECT_GT(light.mean.x, 0.96 * kPi);
}

/// L = emission / (1 − albedo) everywhere in a closed room.
TEST(PlainTracer, AClosedEmittingRoomSumsAllReflections) {
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.7f), glm::vec3(0.3f)), test::Facing::Inward,
                  {-2, -1, -1}, {2, 1, 1});
    expect_light(light_at(scene, {0.5, 0.2, 0.1}), kPi * 0.3 / (1.0 - 0.7));
    expect_light(light_at(scene, {0.5, 0.2, 0.1}, 1), kPi * 0.3 * (1.0 + 0.7));
    expect_light(light_at(scene, {0.5, 0.2, 0.1}, 0), kPi * 0.3);
}

/// A point light at height H above a wide floor of albedo a, and a probe at the same place: the
/// floor shows a I H / (π d³), d² = H² + r², in dω = H 2π r dr / d³. The quarter of the integral
/// is a I / (8 H²).
TEST(PlainTracer, AFloorReflectsAPointLight) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 400.0f);
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(8.0f), {0.0f, 2.0f, 0.0f});
    expect_light(light_at(scene, {0.0, 2.0, 0.0}), 0.5 * 8.0 / (8.0 * 4.0));
    scene.lights[0].indirect_multiplier = 3.0f;
    expect_light(light_at(scene, {0.0, 2.0, 0.0}), 3.0 * 0.5 * 8.0 / (8.0 * 4.0));
    scene.lights[0].mode = LightMode::Realtime;
    EXPECT_EQ(light_at(scene, {0.0, 2.0, 0.0}).mean, glm::dvec3(0.0));
}

/// The mean of max(0, n · l) over all normals is a quarter.
TEST(PlainTracer, DirectLightIsThatOfBakedLights) {
    Scene scene;
    test::add_point_light(scene, LightMode::Baked, glm::vec3(8.0f), {0.0f, 2.0f, 0.0f});
    expect_light(light_at(scene, {0.0, 0.0, 0.0}), 8.0 / 4.0 / 4.0);
    scene.lights[0].mode = LightMode::Mixed;
    EXPECT_EQ(light_at(scene, {0.0, 0.0, 0.0}).mean, glm::dvec3(0.0));
    const auto traced = TraceScene::make_static(scene);
    ASSERT_TRUE(traced);
    const PlainTracer as_baked(scene, *traced, {1000, {LightMode::Baked}});
    expect_light(trace_light(as_baked, {0.0, 0.0, 0.0}, {.sample_count = 4096}), 0.5);
}

/// The light of a small lamp, by lamps of which paths find one half and light samples the other.
TEST(PlainTracer, ASmallLampIsFound) {
    Scene scene;
    const Material lamp = test::diffuse(glm::vec3(0.0f), glm::vec3(1000.0f));
    test::add_ceiling(scene, lamp, 0.005f, 3.0f);
    // Radiance times solid angle, seen from straight below.
    expect_light(light_at(scene, {0.0, 0.0, 0.0}), 0.25 * 1000.0 * 0.0001 / 9.0);
}

/// A square lamp of 1 m², 1000 m from the center of the scene, in strips along x.
Scene far_lamp(uint32_t strips) {
    Scene scene;
    Mesh lamp;
    const float width = 1.0f / static_cast<float>(strips);
    for (uint32_t i = 0; i < strips; ++i) {
        const float x = 1000.0f + static_cast<float>(i) * width;
        test::append_quad(lamp, {x, 2.0f, 0.0f}, {width, 0, 0}, {0, 0, 1});
    }
    test::add_mesh(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(5.0f)), std::move(lamp));
    test::add_box(scene, test::diffuse(glm::vec3(0.0f)), test::Facing::Outward, {-1001, -1, 0},
                  {-1000, 5, 1});
    return scene;
}

/// Strips are as wide as floats are apart at 1000 m: rays to most points hit a strip beside them.
/// The closed form is that of a plane whose center is straight above: the solid angle of a square
/// of side 2a at distance d, 4 asin(a² / (a² + d²)).
TEST(PlainTracer, ALampInStripsAsNarrowAsRoundingHasAllOfItsLight) {
    const double expected = 0.25 * 5.0 * 4.0 * std::asin(0.25 / (0.25 + 1.0));
    for (const uint32_t strips : {1u, 1u << 13}) {
        const TracedLight light = light_at(far_lamp(strips), {1000.5, 1.0, 0.5});
        EXPECT_GT(light.mean.x, 0.0) << strips;
        expect_light(light, expected);
    }
}

/// Two lamps back to back at the same place: each side shows one.
TEST(PlainTracer, LampsBackToBackShineOnce) {
    Scene scene;
    Mesh lamps;
    test::append_quad(lamps, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
    test::append_quad(lamps, {-1, 0, -1}, {2, 0, 0}, {0, 0, 2});
    test::add_mesh(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(5.0f)), std::move(lamps));
    const auto traced = TraceScene::make_static(scene);
    ASSERT_TRUE(traced);
    const PlainEmitters emitters(scene, *traced);
    const glm::vec3 eye = traced->render_from_world({0.0, 1.0, 0.0});
    Pcg random(5, 6);
    int chosen = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto choice = emitters.sample(eye, random);
        const auto surface = traced->intersect({eye, choice.direction});
        if (surface) chosen += PlainEmitters::is_chosen(choice, eye, *surface) ? 1 : 0;
    }
    // Half of all points are on the side that is hit; five standard deviations.
    EXPECT_NEAR(chosen, 500, 5 * 16);
}

/// A half-transparent surface passes half of the light of a point light.
TEST(PlainTracer, ShadowRaysDecideIndependentlyAboutTransparency) {
    Scene scene;
    Material glass = test::diffuse(glm::vec3(0.0f));
    glass.base_color.w = 0.5f;
    glass.alpha_mode = AlphaMode::Blend;
    glass.is_double_sided = true;
    test::add_floor(scene, glass, 1.0f, 1.0f);
    test::add_point_light(scene, LightMode::Baked, glm::vec3(8.0f), {0.0f, 2.0f, 0.0f});
    expect_light(light_at(scene, {0.0, 0.0, 0.0}), 0.5 * 8.0 / 4.0 / 4.0);
}

TEST(PlainTracer, BackFacesAreDark) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_box(scene, test::diffuse(glm::vec3(0.5f), glm::vec3(9.0f)), test::Facing::Outward,
                  {-1, -1, -1}, {1, 1, 1});
    EXPECT_EQ(light_at(scene, {0.0, 0.0, 0.0}, 1000, 1024).mean, glm::dvec3(0.0));
}

}  // namespace
}  // namespace tetralight
