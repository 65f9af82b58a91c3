// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_reflections.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include <tetralight/base/error_text.h>
#include <tetralight/base/half.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/bake_store.h>
#include <tetralight/reflection/reflection_file.h>
#include <tetralight/reflection/relight_reflections.h>
#include <tetralight/reflection/sample_reflections.h>

#include "tests/support/scenes.h"
#include "tests/support/temp_folder.h"

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
              "there are neither reflection probes nor a sky");
    settings = small();
    settings.bake.sample_count = 0;
    EXPECT_EQ(bake_reflections(scene, {}, settings).error().field, "samples");
}

/// A room with a lamp, under a sun that shines in.
Scene lit_room() {
    Scene scene;
    test::add_box(scene, test::diffuse({0.8f, 0.5f, 0.3f}), test::Facing::Inward, {-2, -2, -2},
                  {2, 2, 2});
    test::add_box(scene, test::diffuse(glm::vec3(0.5f), glm::vec3(20.0f)), test::Facing::Outward,
                  {-0.5, 1.5, -0.5}, {0.5, 1.9, 0.5});
    scene.environment.radiance = glm::vec3(0.5f);
    Light light;
    light.type = LightType::Point;
    light.mode = LightMode::Baked;
    light.position = {1.0, -1.0, 1.0};
    light.intensity = glm::vec3(2.0f);
    scene.lights.push_back(light);
    scene.light_names.emplace_back("bulb");
    return scene;
}

float largest_difference(const std::vector<RadianceTexel>& a, const std::vector<RadianceTexel>& b) {
    EXPECT_EQ(a.size(), b.size());
    float largest = 0.0f;
    for (size_t i = 0; i < a.size() && i < b.size(); ++i) {
        for (size_t channel = 0; channel < 3; ++channel) {
            const float x = float_from_half(a[i][channel]), y = float_from_half(b[i][channel]);
            largest = std::max(largest, std::abs(x - y) / std::max(1e-3f, std::max(x, y)));
        }
    }
    return largest;
}

TEST(BakeReflections, LayersAddUpToTheLight) {
    const Scene scene = lit_room();
    const std::vector<ReflectionPlace> places{place_at({0.3, 0, 0.2})};
    BakeReflectionsSettings settings = small();
    const Reflections plain = bake(scene, places, settings).reflections;
    EXPECT_TRUE(plain.layer_levels.empty());
    settings.layers = {"emission"};
    Reflections layered = bake(scene, places, settings).reflections;
    EXPECT_EQ(layered.layer_names, "emission\nrest\n");
    ASSERT_TRUE(verify(layered.view()));
    // Halves, and rest = light - emission.
    EXPECT_LT(largest_difference(layered.levels[0], plain.levels[0]), 2e-3f);
    EXPECT_LT(largest_difference(layered.levels[1], plain.levels[1]), 0.05f);

    // The room without the lamp: emission is all that it had.
    ASSERT_TRUE(relight_reflections(layered, std::vector<LayerWeight>{{"emission", 0.0f}}));
    Scene dark = scene;
    for (Material& material : dark.materials) material.emission = glm::vec3(0.0f);
    const Reflections without = bake(dark, places, small()).reflections;
    for (const glm::vec3 normal : {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1)}) {
        const float expected = evaluate_irradiance(without.probes[0].irradiance, normal).x;
        const float found = evaluate_irradiance(layered.probes[0].irradiance, normal).x;
        EXPECT_NEAR(found, expected, 0.1f * expected);  // noise of 4 paths a texel
        EXPECT_LT(found, 0.5f * evaluate_irradiance(plain.probes[0].irradiance, normal).x);
    }
}

TEST(BakeReflections, TheSkyIsInItsLayer) {
    BakeReflectionsSettings settings = small();
    settings.layers = {"sky", "emission"};
    const BakedReflections baked = bake(sky_scene(glm::vec3(2.0f)), {}, settings);
    Reflections all = baked.reflections;
    EXPECT_EQ(all.layer_names, "sky\nemission\n");
    EXPECT_FALSE(baked.warnings.empty());  // nothing emits light
    ASSERT_TRUE(relight_reflections(all, std::vector<LayerWeight>{{"sky", 0.25f}}));
    for (const auto& level : all.levels) {
        for (const RadianceTexel& texel : level)
            ASSERT_NEAR(float_from_half(texel[0]), 0.5f, 1e-3f);
    }
}

Lightmaps lightmaps_of(const Scene& scene, MixedLighting mixed_lighting = {}) {
    BakeLightmapsSettings settings;
    settings.layout.texels_per_meter = 8.0;
    settings.layout.page_size = 256;
    settings.bake.sample_count = 256;
    settings.lighting.mixed_lighting = mixed_lighting;
    auto baked = bake_lightmaps(scene, settings);
    EXPECT_TRUE(baked) << error_text(baked.error());
    return std::move(baked->lightmaps);
}

TEST(BakeReflections, FromLightmapsIsTheLightOfPaths) {
    const Scene scene = lit_room();
    const std::vector<ReflectionPlace> places{place_at({0.3, 0, 0.2})};
    BakeReflectionsSettings settings = small();
    settings.bake.sample_count = 64;
    const Reflections paths = bake(scene, places, settings).reflections;
    const Lightmaps lightmaps = lightmaps_of(scene);
    settings.bake.sample_count = 4;
    auto baked = bake_reflections(scene, places, settings, {}, {lightmaps.view(), {}});
    ASSERT_TRUE(baked) << error_text(baked.error());
    const Reflections& read = baked->reflections;
    // One ray a sample: every surface has a lightmap, and no light is mixed.
    EXPECT_EQ(baked->ray_count, 4u * cube_texel_count(16));
    for (const glm::vec3 normal :
         {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, -1)}) {
        const float expected = evaluate_irradiance(paths.probes[0].irradiance, normal).x;
        const float found = evaluate_irradiance(read.probes[0].irradiance, normal).x;
        EXPECT_NEAR(found, expected, 0.03f * expected);
    }
}

TEST(BakeReflections, MixedLightsAreAddedToLightmapsOnce) {
    // A floor of albedo 0.5 under a sun of irradiance pi at its zenith has radiance 0.5.
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 5.0f, -1.0f);
    Light sun;
    sun.direction = {0, -1, 0};
    sun.intensity = glm::vec3(std::numbers::pi_v<float>);
    scene.lights.push_back(sun);
    scene.light_names.emplace_back("sun");
    BakeReflectionsSettings settings = small();
    const auto light_below = [&](MixedLighting mixed_lighting) {
        const Lightmaps lightmaps = lightmaps_of(scene, mixed_lighting);
        const auto baked = bake_reflections(scene, std::vector{place_at({0, 0, 0})}, settings, {},
                                            {lightmaps.view(), {}});
        EXPECT_TRUE(baked) << error_text(baked.error());
        const size_t below = 3 * 256 + 8 * 16 + 8;  // the middle of face -Y
        return float_from_half(baked->reflections.levels[0][below][0]);
    };
    scene.lights[0].mode = LightMode::Baked;
    EXPECT_NEAR(light_below(MixedLighting::Indirect), 0.5f, 1e-3f);
    scene.lights[0].mode = LightMode::Mixed;
    EXPECT_NEAR(light_below(MixedLighting::Indirect), 0.5f, 1e-3f);
    EXPECT_NEAR(light_below(MixedLighting::Shadowmask), 0.5f, 1e-3f);
    EXPECT_NEAR(light_below(MixedLighting::Subtractive), 0.5f, 1e-3f);
}

TEST(BakeReflections, RefusesLightmapsThatAreOfNoUse) {
    const Scene scene = lit_room();
    Lightmaps lightmaps = lightmaps_of(scene);
    const std::vector places{place_at({0, 0, 0})};
    const auto error = [&](const Scene& used, const BakeReflectionsSettings& settings) {
        const auto baked = bake_reflections(used, places, settings, {}, {lightmaps.view(), {}});
        return baked ? "" : error_text(baked.error());
    };
    Scene other = scene;
    other.instances.pop_back();
    EXPECT_NE(error(other, small()), "");
    const auto warnings = [&](const Scene& used) {
        return bake_reflections(used, places, small(), {}, {lightmaps.view(), {}})->warnings;
    };
    EXPECT_TRUE(warnings(scene).empty());
    other = scene;
    other.environment.radiance *= 2.0f;
    ASSERT_EQ(warnings(other).size(), 1u);
    EXPECT_EQ(warnings(other)[0],
              "the lightmaps were baked for other lights, surfaces or options than the scene has "
              "now: reflections show both");
    BakeReflectionsSettings layered = small();
    layered.layers = {"emission"};
    EXPECT_EQ(error(scene, layered), "layers: are baked by paths, not from lightmaps");
    lightmaps.layers.resize(1);
    lightmaps.layers[0].weight = 0.5f;
    EXPECT_EQ(error(scene, small()),
              "the lightmaps were relit; reflections need their light as it was baked");
}

TEST(BakeReflections, IsRefusedBeforeItBegins) {
    const Scene scene = sky_scene(glm::vec3(1.0f));
    const auto error = [&](const std::vector<ReflectionPlace>& places,
                           const std::vector<std::string>& layers) {
        BakeReflectionsSettings settings = small();
        settings.layers = layers;
        const Status status = check_reflections(scene, places, settings);
        return status ? "" : error_text(status.error());
    };
    std::vector places{place_at({0, 0, 0}), place_at({0, 1, 0})};
    EXPECT_EQ(error(places, {}), "");
    places[1].name = "ro\tom";
    EXPECT_TRUE(error(places, {}).starts_with("reflection probe 1, \"")) << error(places, {});
    places.assign(40'000, place_at({0, 0, 0}));
    EXPECT_EQ(error(places, {}), "");
    EXPECT_EQ(error(places, {"sky"}),
              "80002 cubes, with those of the sky and of layers, are more than 65536");
    EXPECT_NE(error({}, {"moon"}), "");
    EXPECT_EQ(error({}, {"transfer"}),
              "layers: reflection probes have no transfer of distant light");
}

TEST(BakeReflections, StoresGiveTheSameBytesAndOnlyBakeWhatIsMissing) {
    const TempFolder folder;
    const Scene scene = lit_room();
    const std::vector places{place_at({0, 0, 0}), place_at({1, 0.5, -1})};
    BakeReflectionsSettings settings = small(1);
    settings.bake.sample_count = 32;  // a cube takes longer than the pause between reports
    settings.layers = {"emission"};
    const BakedReflections plain = bake(scene, places, settings);

    auto store = BakeStore::open(folder.path("store"));
    ASSERT_TRUE(store);
    const BakeStorage storage{{&*store}, &*store, 0.0, true, true};
    // Cancelled within the second cube.
    const auto stop = [](const BakeProgress& progress) { return progress.probes_done < 100; };
    const auto cancelled = bake_reflections(scene, places, settings, stop, {{}, storage});
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().code, ErrorCode::Cancelled);

    uint64_t first_done = UINT64_MAX;
    const auto count = [&](const BakeProgress& progress) {
        first_done = std::min<uint64_t>(first_done, progress.probes_done);
        EXPECT_EQ(progress.probe_count, 2u * 6u * 16u);
        return true;
    };
    const auto resumed = bake_reflections(scene, places, settings, count, {{}, storage});
    ASSERT_TRUE(resumed) << error_text(resumed.error());
    EXPECT_GE(first_done, 6u * 16u);  // one cube was known
    EXPECT_GT(resumed->stored.earlier_ray_count, 0u);
    EXPECT_EQ(reflection_file_bytes(resumed->reflections),
              reflection_file_bytes(plain.reflections));

    // Other light is not taken.
    settings.bake.seed = 9;
    const auto other = bake_reflections(scene, places, settings, {}, {{}, storage});
    ASSERT_TRUE(other);
    EXPECT_EQ(other->stored.earlier_ray_count, 0u);
}

}  // namespace
}  // namespace tetralight
