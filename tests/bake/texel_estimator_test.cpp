// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/bake/probe_estimator.h>
#include <tetralight/bake/sampling/sampling.h>
#include "tests/support/scenes.h"

// The light of texels where it has a closed form.

namespace tetralight {
namespace {

constexpr double kPi = std::numbers::pi;

constexpr double kY0 = 0.28209479177387814, kY1 = 0.4886025119029199;

/// ∫ L dω and ∫ L ω dω of the red channel, the latter in world axes.
struct TexelLight {
    double flux = 0.0;
    glm::dvec3 vector{0.0};

    [[nodiscard]] double irradiance(glm::dvec3 normal) const { return glm::dot(vector, normal); }
};

TexelLight light_of(const RadianceSh& local, glm::vec3 normal) {
    const auto& c = local.coefficients;
    const glm::vec3 in_frame(c[3].x, c[1].x, c[2].x);
    return {double{c[0].x} / kY0, glm::dvec3(frame_around(normal) * in_frame) / kY1};
}

TexelLight bake_texel(const Scene& scene, glm::vec3 position, glm::vec3 normal,
                      uint32_t sample_count = 4096) {
    const auto traced = TraceScene::make_static(scene);
    EXPECT_TRUE(traced);
    const PathTracer tracer(scene, *traced, {});
    const glm::vec3 offset = 1e-4f * normal;
    const auto estimate =
        estimate_texel(tracer, traced->render_from_world(glm::dvec3(position)),
                       {normal, {&offset, 1}}, probe_key(1, glm::dvec3(position)), sample_count);
    return light_of(estimate.radiance, normal);
}

Scene white_sky() {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    return scene;
}

TEST(TexelEstimator, SkyGivesPiAndTwoPi) {
    Scene scene = white_sky();
    test::add_floor(scene, test::diffuse(glm::vec3(0.0f)), 100.0f);
    const TexelLight light = bake_texel(scene, {0, 0, 0}, {0, 1, 0});
    EXPECT_NEAR(light.irradiance({0, 1, 0}), kPi, 0.01);
    EXPECT_NEAR(light.flux, 2.0 * kPi, 0.03);
    EXPECT_NEAR(light.vector.x, 0.0, 0.02);
    EXPECT_NEAR(light.vector.z, 0.0, 0.02);
}

TEST(TexelEstimator, LightBelowTheSurfaceDoesNotCount) {
    // A tilted texel without a surface: half of the sky below it is visible, and does not count.
    const glm::vec3 normal = glm::normalize(glm::vec3(1, 2, -3));
    Scene scene = white_sky();
    test::add_floor(scene, test::diffuse(glm::vec3(0.0f)), 1.0f, -1e4f);
    const TexelLight light = bake_texel(scene, {0, 0, 0}, normal);
    EXPECT_NEAR(light.irradiance(normal), kPi, 0.01);
    EXPECT_NEAR(glm::length(light.vector - kPi * glm::dvec3(normal)), 0.0, 0.03);
}

TEST(TexelEstimator, WallHidesHalfOfTheSky) {
    Scene scene = white_sky();
    test::add_floor(scene, test::diffuse(glm::vec3(0.0f)), 100.0f);
    test::add_quad(scene, test::diffuse(glm::vec3(0.0f)), {0, 0, 100}, {0, 0, -200}, {0, 200, 0});
    // ∫ cos θ over half of the hemisphere; ∫ sin θ cos φ over the same half is π/2.
    const TexelLight light = bake_texel(scene, {0.01f, 0, 0}, {0, 1, 0}, 16384);
    EXPECT_NEAR(light.irradiance({0, 1, 0}), 0.5 * kPi, 0.01);
    EXPECT_NEAR(light.vector.x, 0.5 * kPi, 0.02);
    EXPECT_NEAR(light.flux, kPi, 0.02);
}

TEST(TexelEstimator, BakedPointLightFallsByCosineAndSquare) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.0f)), 100.0f);
    Light light;
    light.type = LightType::Point;
    light.mode = LightMode::Baked;
    light.position = {3, 4, 0};
    light.intensity = glm::vec3(50.0f);
    scene.lights.push_back(light);
    scene.light_names.emplace_back("lamp");
    const TexelLight texel = bake_texel(scene, {0, 0, 0}, {0, 1, 0}, 64);
    EXPECT_NEAR(texel.irradiance({0, 1, 0}), 50.0 / 25.0 * 0.8, 1e-4);
    EXPECT_NEAR(texel.vector.x, 50.0 / 25.0 * 0.6, 1e-4);
    EXPECT_EQ(bake_texel(scene, {0, -1, 0}, {0, -1, 0}, 64).flux, 0.0);
}

TEST(TexelEstimator, MixedLightLeavesOnlyItsBounce) {
    // A floor that nothing faces receives nothing from a mixed light.
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 100.0f);
    Light sun;
    sun.type = LightType::Directional;
    sun.mode = LightMode::Mixed;
    sun.direction = {0, -1, 0};
    sun.intensity = glm::vec3(2.0f);
    scene.lights.push_back(sun);
    scene.light_names.emplace_back("sun");
    EXPECT_EQ(bake_texel(scene, {0, 0, 0}, {0, 1, 0}, 256).flux, 0.0);
    // A ceiling above it receives albedo / π · E from all of its hemisphere.
    const TexelLight above = bake_texel(scene, {0, 0.5f, 0}, {0, -1, 0});
    EXPECT_NEAR(above.irradiance({0, -1, 0}), 0.5 * 2.0, 0.01);
}

TEST(TexelEstimator, OriginsShareTheSamples) {
    // Half of the origins lie below the floor.
    Scene scene = white_sky();
    test::add_floor(scene, test::diffuse(glm::vec3(0.0f)), 100.0f);
    const auto traced = TraceScene::make_static(scene);
    ASSERT_TRUE(traced);
    const PathTracer tracer(scene, *traced, {});
    const std::array<glm::vec3, 4> origins{glm::vec3(0, 1, 0), glm::vec3(0, -1, 0),
                                           glm::vec3(0, 2, 0), glm::vec3(0, -2, 0)};
    const glm::vec3 up(0, 1, 0);
    const auto estimate = estimate_texel(tracer, glm::vec3(0.0f), {up, origins}, 7, 1024);
    EXPECT_NEAR(light_of(estimate.radiance, up).irradiance(up), 0.5 * kPi, 0.02);
    EXPECT_NEAR(estimate.back_face_count, 512, 8);
}

/// A lit room with a lamp and a window, and texels on its floor.
struct NoisyTexels {
    Scene scene;
    std::vector<glm::dvec3> positions;
    std::vector<TexelSurfaces::Texel> texels;
    std::vector<glm::vec3> origins{{0, 1e-4f, 0}};

    NoisyTexels() {
        scene.environment.radiance = glm::vec3(0.5f);
        test::add_box(scene, test::diffuse(glm::vec3(0.6f)), test::Facing::Inward, {-2, 0, -2},
                      {2, 3, 2});
        test::add_box(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(30.0f)),
                      test::Facing::Outward, {0.5f, 2, 0.5f}, {0.7f, 2.2f, 0.7f});
        for (int i = 0; i < 24; ++i) {
            positions.emplace_back(-1.8 + 0.15 * i, 0.0, 0.07 * i - 1.0);
            texels.push_back({{0, 1, 0}, 0, 1});
        }
    }

    [[nodiscard]] std::vector<ProbeAccumulator> bake(const BakeSettings& settings) const {
        std::vector<ProbeAccumulator> accumulators(positions.size());
        EXPECT_TRUE(
            bake_accumulators(scene, {positions, {texels, origins}}, settings, accumulators));
        return accumulators;
    }
};

TEST(TexelEstimator, ErrorBarsAreThoseOfTheIrradiance) {
    const NoisyTexels room;
    BakeSettings rough, fine;
    rough.sample_count = 256;
    fine.sample_count = 65536;
    fine.seed = 5;
    const auto measured = room.bake(rough), truth = room.bake(fine);
    double squares = 0.0;
    for (size_t i = 0; i < measured.size(); ++i) {
        const glm::vec3 a = measured[i].radiance().coefficients[2];
        const glm::vec3 b = truth[i].radiance().coefficients[2];
        const double error = double{measured[i].sampling_error(ErrorMeasure::OwnNormal)};
        squares += std::pow(double{glm::length(a - b) / glm::length(b)} / error, 2);
    }
    // Mean of 24 squares with eight estimates each, whose channels vary together: F(1, 7).
    EXPECT_NEAR(squares / static_cast<double>(measured.size()), 1.4, 1.3);
}

TEST(TexelEstimator, ReachesTheTargetErrorAndDependsOnNoThread) {
    const NoisyTexels room;
    BakeSettings settings;
    settings.sample_count = 128;
    settings.target_error = 0.03;
    settings.thread_count = 1;
    const auto once = room.bake(settings);
    for (const ProbeAccumulator& texel : once) {
        EXPECT_LE(texel.sampling_error(ErrorMeasure::OwnNormal), 0.03f);
    }
    settings.thread_count = 3;
    EXPECT_EQ(room.bake(settings), once);
}

}  // namespace
}  // namespace tetralight
