// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/path_tracer.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/bake/sampling/sampling.h>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

const glm::vec3 kDown(0.0f, -1.0f, 0.0f);

/// Light along one path that starts at a world position.
PathSample trace(const Scene& scene, glm::vec3 origin, glm::vec3 direction, uint32_t bounces) {
    const auto trace_scene = TraceScene::make_static(scene);
    EXPECT_TRUE(trace_scene);
    const PathTracer tracer(scene, *trace_scene, {bounces});
    return tracer.trace({trace_scene->render_from_world(glm::dvec3(origin)), direction},
                        Sampler(1, 2));
}

/// A wide floor of albedo 1/2 at y = 0, and nothing else.
Scene floor_scene() {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 1000.0f);
    return scene;
}

TEST(SampleStart, DirectionsAtTheHorizonHaveADensity) {
    constexpr float kBelowOne = 1.0f - 0x1p-24f;
    for (uint64_t i = 0; i < 100'000; ++i) {
        RandomStream random(i, 0);
        const glm::vec3 normal = sample_rotation(random)[2];
        for (const float u : {0.1f, 0.9f}) {
            const glm::vec3 direction = sample_start(normal, {u, kBelowOne});
            ASSERT_GT(start_pdf(normal, direction), 0.0f) << i;
            ASSERT_NEAR(glm::dot(normal, direction), 0.0f, 1e-3f);
            ASSERT_NEAR(glm::length(direction), 1.0f, 1e-6f);
        }
    }
}

TEST(PathTracer, WithoutBouncesOnlySkyAndEmissionAreSeen) {
    Scene scene;
    scene.environment.radiance = glm::vec3(7.0f);
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f), {1, 2, 3}), 10.0f);
    test::add_sun(scene, LightMode::Mixed, glm::vec3(100.0f));
    EXPECT_EQ(trace(scene, {0, 1, 0}, kDown, 0).radiance, glm::vec3(1, 2, 3));
    EXPECT_EQ(trace(scene, {0, 1, 0}, -kDown, 0).radiance, glm::vec3(7.0f));
}

TEST(PathTracer, FloorReflectsTheSkyTimesItsAlbedo) {
    // All of the hemisphere over a plane is sky: each path ends there with throughput 1/2.
    Scene scene = floor_scene();
    scene.environment.radiance = {2, 4, 6};
    EXPECT_EQ(trace(scene, {0, 1, 0}, kDown, 1).radiance, glm::vec3(1, 2, 3));
}

TEST(PathTracer, FloorReflectsTheSunAsLambertDoes) {
    // albedo/π · E · cos 60° = 0.5/π · 8 · 0.5
    Scene scene = floor_scene();
    test::add_sun(scene, LightMode::Mixed, glm::vec3(8.0f)).direction = {0.8660254f, -0.5f, 0};
    EXPECT_NEAR(trace(scene, {0, 1, 0}, kDown, 1).radiance.x, 2.0f / std::numbers::pi_v<float>,
                1e-5f);
}

TEST(PathTracer, RoofAboveTheLightDoesNotShadowTheFloor) {
    // albedo/π · I/d² = 0.5/π · 8/2², as if there were no roof at height 3.
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 5.0f);
    test::add_ceiling(scene, test::diffuse(glm::vec3(0.0f)), 5.0f, 3.0f);
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(8.0f), {0, 2, 0});
    EXPECT_NEAR(trace(scene, {0, 1, 0}, kDown, 1).radiance.x, 1.0f / std::numbers::pi_v<float>,
                1e-4f);
}

TEST(PathTracer, LightBehindASurfaceDoesNotReachItsFront) {
    Scene scene = floor_scene();
    test::add_sun(scene, LightMode::Mixed, glm::vec3(8.0f)).direction = {0, 1, 0};
    EXPECT_EQ(trace(scene, {0, 1, 0}, kDown, 1).radiance, glm::vec3(0.0f));
}

TEST(PathTracer, PolishedMetalHasNoDiffuseBounce) {
    Scene scene = floor_scene();
    scene.materials[0].metallic = 1.0f;
    scene.materials[0].roughness = 0.0f;
    scene.environment.radiance = glm::vec3(1.0f);
    EXPECT_EQ(trace(scene, {0, 1, 0}, kDown, 4).radiance, glm::vec3(0.0f));
}

TEST(PathTracer, BackFaceIsBlackAndReported) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f), glm::vec3(5.0f)), 10.0f);
    const PathSample sample = trace(scene, {0, -1, 0}, -kDown, 4);
    EXPECT_EQ(sample.radiance, glm::vec3(0.0f));
    EXPECT_TRUE(sample.hit_back_face);
    EXPECT_FALSE(trace(scene, {0, 1, 0}, kDown, 4).hit_back_face);
}

TEST(PathTracer, BackFaceOnALaterSegmentOnlyEndsThePath) {
    Scene scene = floor_scene();
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1e6f, 5.0f);  // its back is above us
    const PathSample sample = trace(scene, {0, 1, 0}, kDown, 4);
    EXPECT_EQ(sample.radiance, glm::vec3(0.0f));
    EXPECT_FALSE(sample.hit_back_face);
    EXPECT_EQ(sample.ray_count, 2u);
}

TEST(PathTracer, DoubleSidedSurfaceShinesOnBothSides) {
    Scene scene;
    Material material = test::diffuse(glm::vec3(0.5f), glm::vec3(5.0f));
    material.is_double_sided = true;
    scene.environment.radiance = glm::vec3(2.0f);
    test::add_floor(scene, material, 10.0f);
    const PathSample sample = trace(scene, {0, -1, 0}, -kDown, 1);
    EXPECT_EQ(sample.radiance, glm::vec3(6.0f));  // emission 5 + albedo 0.5 · sky 2
    EXPECT_FALSE(sample.hit_back_face);
}

/// True if a position sees the only light of a scene.
bool is_lit(const Scene& scene, glm::vec3 position) {
    const auto trace_scene = TraceScene::make_static(scene);
    const PathTracer tracer(scene, *trace_scene, {});
    const LightSample sample = sample_light(tracer.baked_lights()[0], position, {0.5f, 0.5f});
    return !tracer.occluded(position, sample);
}

TEST(PathTracer, OnlySurfacesInFrontOfTheLightOccludeIt) {
    Scene scene = floor_scene();
    test::add_point_light(scene, LightMode::Baked, glm::vec3(9.0f), {0, 1, 0});
    EXPECT_TRUE(is_lit(scene, {4, 3, 0}));
    EXPECT_TRUE(is_lit(scene, {0, 4, 0}));  // the floor is 1 m behind the light
    EXPECT_FALSE(is_lit(scene, {0, -1, 0}));
}

TEST(PathTracer, SamePathForTheSameRandomNumbers) {
    Scene scene;
    test::add_box(scene, test::diffuse({0.9f, 0.5f, 0.1f}), test::Facing::Inward, {-1, -1, -1},
                  {1, 1, 1});
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(1.0f), {0.5f, 0.5f, 0.5f});
    EXPECT_EQ(trace(scene, {0, 0, 0}, kDown, 5).radiance,
              trace(scene, {0, 0, 0}, kDown, 5).radiance);
}

}  // namespace
}  // namespace tetralight
