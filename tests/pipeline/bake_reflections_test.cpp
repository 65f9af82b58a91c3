// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_reflections.h>

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include <tetralight/base/error_text.h>
#include <tetralight/base/half.h>
#include <tetralight/reflection/reflection_file.h>
#include <tetralight/reflection/sample_reflections.h>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

BakeReflectionsSettings small(uint32_t thread_count = 0) {
    BakeReflectionsSettings settings;
    settings.cube_size = 16;
    settings.bake.sample_count = 4;
    settings.bake.thread_count = thread_count;
    return settings;
}

Scene sky_scene(glm::vec3 radiance) {
    Scene scene;
    scene.environment.radiance = radiance;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 1.0f, -1.0f);
    return scene;
}

ReflectionPlace place_at(const glm::dvec3& position) {
    ReflectionPlace place;
    place.name = "hall";
    place.position = position;
    place.box_center = {0.5f, 0.0f, 0.0f};
    place.half_size = {2.0f, 2.0f, 2.0f};
    return place;
}

BakedReflections bake(const Scene& scene, const std::vector<ReflectionPlace>& places,
                      const BakeReflectionsSettings& settings) {
    auto baked = bake_reflections(scene, places, settings);
    EXPECT_TRUE(baked) << error_text(baked.error());
    return std::move(*baked);
}

TEST(BakeReflections, TheSkyIsTheLastProbeAndIsEverywhere) {
    const glm::vec3 scene_light(1, 2, 3);
    const Reflections all =
        bake(sky_scene(scene_light), {place_at({0, 1, 0})}, small()).reflections;
    ASSERT_EQ(all.names, (std::vector<std::string>{"hall", "sky"}));
    EXPECT_FALSE(all.probes[0].is_everywhere());
    EXPECT_TRUE(all.probes[1].is_everywhere());
    EXPECT_TRUE(verify(all.view()));
    for (uint32_t level = 0; level < all.levels.size(); ++level)
        EXPECT_EQ(all.levels[level].size(), 2 * cube_texel_count(16u >> level));
    // Outside the box the sky is seen, in every direction and roughness.
    const glm::dvec3 far(100.0, 0.0, 0.0);
    const ReflectionBlend blend = blend_reflections(all.view(), far);
    for (const float roughness : {0.0f, 0.4f, 1.0f}) {
        const glm::vec3 light =
            sample_reflections(all.view(), blend, far, {0.3f, -0.8f, 0.5f}, roughness);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(light[i], scene_light[i], 2e-3f);
    }
}

TEST(BakeReflections, TheIrradianceOfAConstantSkyIsPi) {
    const Reflections all = bake(sky_scene(glm::vec3(1.0f)), {}, small()).reflections;
    for (const glm::vec3 normal : {glm::vec3(0, 1, 0), glm::vec3(0.6f, 0, -0.8f)}) {
        const float irradiance = evaluate_irradiance(all.probes[0].irradiance, normal).x;
        EXPECT_NEAR(irradiance, std::numbers::pi_v<float>, 0.01f);
    }
}

TEST(BakeReflections, LightAboveTheLargestHalfIsClampedAndTold) {
    const BakedReflections baked = bake(sky_scene(glm::vec3(2.0f * 65504.0f)), {}, small());
    EXPECT_NEAR(baked.facts[0].clamped_share, 0.5, 1e-6);
    EXPECT_EQ(baked.reflections.levels[0][0][0], half_from_float(65504.0f));
    ASSERT_EQ(baked.warnings.size(), 1u);
    EXPECT_EQ(baked.warnings[0],
              "reflection probe \"sky\": 50 % of its light is brighter than a half can be, and was "
              "clamped");
}

TEST(BakeReflections, APlaceInsideGeometryIsMovedOutAndItsBoxStays) {
    Scene scene = sky_scene(glm::vec3(1.0f));
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward, {-1, 0, -1},
                  {1, 2, 1});
    const ReflectionPlace place = place_at({0.9, 1.0, 0.0});
    const BakedReflections baked = bake(scene, {place}, small());
    const ReflectionProbe& probe = baked.reflections.probes[0];
    EXPECT_GT(probe.position.x, 1.0);
    EXPECT_GT(baked.facts[0].virtual_offset, 0.1f);
    EXPECT_EQ(baked.facts[0].validity, 1.0f);
    const glm::dvec3 before = place.position + glm::dvec3(place.box_center);
    const glm::dvec3 after = probe.position + glm::dvec3(probe.box_center);
    EXPECT_NEAR(after.x, before.x, 1e-6);
    EXPECT_NEAR(after.y, before.y, 1e-6);
}

TEST(BakeReflections, APlaceDeepInsideGeometryWarns) {
    Scene scene = sky_scene(glm::vec3(1.0f));
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward, glm::vec3(-9),
                  glm::vec3(9));
    const BakedReflections baked = bake(scene, {place_at({0, 0, 0})}, small());
    ASSERT_EQ(baked.warnings.size(), 1u);
    EXPECT_EQ(baked.warnings[0], "reflection probe \"hall\" lies inside geometry");
    // The floor of half size 1 at distance 1 has a sixth of all directions.
    EXPECT_NEAR(baked.facts[0].validity, 1.0f / 6.0f, 0.01f);
}

TEST(BakeReflections, SameBytesForAnyNumberOfThreads) {
    const Scene scene = sky_scene({0.5f, 1.0f, 2.0f});
    const std::vector<ReflectionPlace> places{place_at({0, 1, 0})};
    EXPECT_EQ(reflection_file_bytes(bake(scene, places, small(1)).reflections),
              reflection_file_bytes(bake(scene, places, small(2)).reflections));
}

TEST(BakeReflections, MetadataHasTheSettings) {
    BakeReflectionsSettings settings = small();
    settings.bake.clamp = 5.0f;
    const auto json =
        nlohmann::json::parse(bake(sky_scene(glm::vec3(1.0f)), {}, settings).reflections.metadata);
    EXPECT_EQ(json["cube_size"], 16);
    EXPECT_EQ(json["samples"], 4);
    EXPECT_EQ(json["clamp"], 5);
    EXPECT_FALSE(json.contains("max_albedo"));
}

TEST(BakeReflections, RefusesWrongSettingsAndEmptyScenes) {
    BakeReflectionsSettings settings = small();
    settings.cube_size = 24;
    const Scene scene = sky_scene(glm::vec3(1.0f));
    EXPECT_EQ(error_text(bake_reflections(scene, {}, settings).error()),
              "cube_size: 24 is not a power of two from 8 to 4096");
    EXPECT_EQ(error_text(bake_reflections(sky_scene(glm::vec3(0.0f)), {}, small()).error()),
              "the scene has neither reflection probes nor a sky");
    settings = small();
    settings.bake.sample_count = 0;
    EXPECT_EQ(bake_reflections(scene, {}, settings).error().field, "samples");
}

}  // namespace
}  // namespace tetralight
