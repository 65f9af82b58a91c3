// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_lightmaps.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <tetralight/base/error_text.h>
#include <tetralight/base/half.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/lightmap/sample_lightmap.h>
#include <tetralight/pipeline/bake_store.h>
#include "tests/support/mapped_wall.h"
#include "tests/support/scenes.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

constexpr double kPi = std::numbers::pi;

const Material kGrey = test::diffuse(glm::vec3(0.5f));

BakeLightmapsSettings settings_with(uint32_t samples, double texels_per_meter = 4.0) {
    BakeLightmapsSettings settings;
    settings.layout.texels_per_meter = texels_per_meter;
    settings.layout.page_size = 128;
    settings.bake.sample_count = samples;
    return settings;
}

Lightmaps bake(const Scene& scene, const BakeLightmapsSettings& settings,
               const BakeStorage& storage = {}) {
    auto baked = bake_lightmaps(scene, settings, storage);
    EXPECT_TRUE(baked) << (baked ? "" : error_text(baked.error()));
    return baked ? std::move(baked->lightmaps) : Lightmaps{};
}

std::string error_of(const Scene& scene, const BakeLightmapsSettings& settings) {
    const auto baked = bake_lightmaps(scene, settings);
    return baked ? "" : error_text(baked.error());
}

/// Green irradiance of all covered texels of an instance.
std::vector<float> irradiance_of(const Lightmaps& maps, size_t instance) {
    const LightmapRectangle& place = maps.rectangles[instance];
    std::vector<float> values;
    for (uint32_t y = place.y; y < place.y + place.height; ++y) {
        for (uint32_t x = place.x; x < place.x + place.width; ++x) {
            const size_t size = maps.info.page_size;
            const IrradianceTexel& texel = maps.irradiance[(place.page * size + y) * size + x];
            if (texel.coverage == kCovered)
                values.push_back(float_from_half(texel.rgb[1]) * maps.info.scale);
        }
    }
    return values;
}

void add_sun(Scene& scene, glm::vec3 direction, LightMode mode, float intensity = 3.0f) {
    Light sun;
    sun.type = LightType::Directional;
    sun.mode = mode;
    sun.direction = glm::normalize(direction);
    sun.intensity = glm::vec3(intensity);
    scene.lights.push_back(sun);
    scene.light_names.emplace_back("sun");
}

TEST(BakeLightmaps, AFloorUnderAWhiteSkyReceivesPi) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, kGrey, 2.0f);
    const Lightmaps maps = bake(scene, settings_with(256));
    EXPECT_TRUE(verify(maps.view()));
    const auto values = irradiance_of(maps, 0);
    EXPECT_GE(values.size(), 16u * 16u);
    for (const float value : values) EXPECT_NEAR(double{value}, kPi, 0.03);
    const glm::vec3 tilted = glm::normalize(glm::vec3(0.3f, 1, 0));
    const glm::vec2 uv = page_uv(maps.rectangles[0], {0.5f, 0.5f});
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    // The part of the sky that both normals see.
    EXPECT_NEAR(double{sample_lightmap(maps.view(), 0, uv, {up, tilted}).y},
                kPi * 0.5 * (1.0 + double{tilted.y}), 0.04);
}

/// A floor with a normal map that is tilted everywhere, and the angle of the tilt's cosine.
struct MappedFloor {
    Scene scene;
    glm::vec3 normal;
    BakeLightmapsSettings settings = settings_with(256);

    MappedFloor() {
        Material material = kGrey;
        test::set_normal_map(scene, material, {0.6f, 0.0f});
        test::add_floor(scene, material, 2.0f);
        // u of the floor runs along +Z.
        const glm::vec3 stored = test::stored_normal({0.6f, 0.0f});
        normal = {-stored.y, stored.z, stored.x};
        settings.has_normal_maps = true;
    }
};

TEST(BakeLightmaps, NormalMapsSeeTheirPartOfTheSky) {
    MappedFloor floor;
    floor.scene.environment.radiance = glm::vec3(1.0f);
    const double expected = kPi * 0.5 * (1.0 + double{floor.normal.y});
    const Lightmaps maps = bake(floor.scene, floor.settings);
    for (const float value : irradiance_of(maps, 0)) EXPECT_NEAR(double{value}, expected, 0.03);
    EXPECT_NE(maps.metadata.find("normal_maps"), std::string::npos);
    floor.settings.has_normal_maps = false;
    for (const float value : irradiance_of(bake(floor.scene, floor.settings), 0))
        EXPECT_NEAR(double{value}, kPi, 0.03);
}

TEST(BakeLightmaps, WarnsOnceOfNormalMapsWithoutTextureCoordinates) {
    const auto warnings = [](const MappedFloor& floor) {
        const auto prepared = prepare_lightmaps(floor.scene, floor.settings);
        EXPECT_TRUE(prepared) << error_text(prepared.error());
        return prepared ? prepared->report.warnings : std::vector<std::string>();
    };
    MappedFloor floor;
    floor.scene.instances[0].name = "first";
    EXPECT_TRUE(warnings(floor).empty());
    floor.scene.meshes[0].uvs[0].clear();
    EXPECT_EQ(warnings(floor),
              std::vector<std::string>{"the normal map of 1 object is not baked: its mesh has no "
                                       "texture coordinates for it (\"first\")"});
    floor.scene.instances.push_back(floor.scene.instances[0]);
    floor.scene.instances[1].name = "second";
    EXPECT_EQ(warnings(floor), std::vector<std::string>{
                                   "the normal maps of 2 objects are not baked: their meshes have "
                                   "no texture coordinates for them (the first is \"first\")"});
    floor.settings.only = {"second"};
    EXPECT_EQ(warnings(floor),
              std::vector<std::string>{"the normal map of 1 object is not baked: its mesh has no "
                                       "texture coordinates for it (\"second\")"});
    floor.settings.has_normal_maps = false;
    EXPECT_TRUE(warnings(floor).empty());
}

TEST(BakeLightmaps, NormalMapsFaceTheSunAndKeepItsLayer) {
    MappedFloor floor;
    floor.scene.environment.radiance = glm::vec3(1.0f);
    const glm::vec3 down = glm::normalize(glm::vec3(0, -1, -1));
    add_sun(floor.scene, down, LightMode::Baked);
    floor.settings.lighting.layers = {"sun"};
    const Lightmaps maps = bake(floor.scene, floor.settings);
    const double sun = -3.0 * double{glm::dot(down, floor.normal)};
    const double sky = kPi * 0.5 * (1.0 + double{floor.normal.y});
    for (const float value : irradiance_of(maps, 0)) EXPECT_NEAR(double{value}, sun + sky, 0.05);
    for (size_t i = 0; i < maps.irradiance.size(); ++i) {
        if (maps.irradiance[i].rgb[1] == 0) continue;
        const float layer = float_from_half(maps.layer_irradiance[i].rgb[1]) * maps.layers[0].scale;
        EXPECT_NEAR(double{layer}, sun, 0.02);
    }
}

TEST(BakeLightmaps, BakedSunFallsByItsCosineAndMixedSunDoesNotFall) {
    Scene scene;
    test::add_floor(scene, kGrey, 2.0f);
    add_sun(scene, {0, -1, -1}, LightMode::Baked);
    for (const float value : irradiance_of(bake(scene, settings_with(16)), 0))
        EXPECT_NEAR(double{value}, 3.0 * std::sqrt(0.5), 2e-3);
    scene.lights[0].mode = LightMode::Mixed;
    for (const float value : irradiance_of(bake(scene, settings_with(16)), 0))
        EXPECT_EQ(value, 0.0f);
}

TEST(BakeLightmaps, ASealedRoomUnderASunIsBlack) {
    Scene scene;
    add_sun(scene, {0.3f, -1, 0.2f}, LightMode::Baked);
    test::add_floor(scene, kGrey, 4.0f);
    // Walls of 10 cm that stand in the floor.
    test::add_box(scene, kGrey, test::Facing::Outward, {-1.1f, -0.2f, -1.1f}, {1.1f, 1.1f, 1.1f});
    test::add_box(scene, kGrey, test::Facing::Inward, {-1, -0.1f, -1}, {1, 1, 1});
    const Lightmaps maps = bake(scene, settings_with(256, 10.0));
    const auto outside = irradiance_of(maps, 0), inside = irradiance_of(maps, 2);
    const float brightest = *std::ranges::max_element(outside);
    const double sun = 3.0 / std::sqrt(1.13);
    EXPECT_GT(double{brightest}, 0.99 * sun);
    EXPECT_LT(double{brightest}, 1.5 * sun);  // with what the walls reflect
    for (const float value : inside) EXPECT_LE(value, 1e-3f * brightest);
}

TEST(BakeLightmaps, LayersAddUpToTheLight) {
    Scene scene;
    scene.environment.radiance = glm::vec3(0.4f);
    // Two tiles, whose seam crosses the shadow of the box.
    test::add_quad(scene, kGrey, {-2, 0, -2}, {0, 0, 4}, {2, 0, 0});
    test::add_quad(scene, kGrey, {0, 0, -2}, {0, 0, 4}, {2, 0, 0});
    test::add_box(scene, test::diffuse(glm::vec3(0.2f), glm::vec3(5.0f)), test::Facing::Outward,
                  {-0.3f, 0.2f, -0.3f}, {0.3f, 0.8f, 0.3f});
    add_sun(scene, {0.5f, -1, 0}, LightMode::Baked);
    BakeLightmapsSettings settings = settings_with(128);
    settings.lighting.layers = {"sun", "sky"};
    const Lightmaps maps = bake(scene, settings);
    EXPECT_EQ(maps.layer_names, "sun\nsky\nrest\n");
    EXPECT_TRUE(verify(maps.view()));
    const size_t count = maps.irradiance.size();
    float worst = 0.0f, brightest = 0.0f;
    for (size_t i = 0; i < count; ++i) {
        float sum = 0.0f;
        for (size_t layer = 0; layer < 3; ++layer) {
            const uint16_t half = maps.layer_irradiance[layer * count + i].rgb[0];
            sum += float_from_half(half) * maps.layers[layer].scale;
        }
        const float total = float_from_half(maps.irradiance[i].rgb[0]) * maps.info.scale;
        worst = std::max(worst, std::abs(sum - total));
        brightest = std::max(brightest, total);
    }
    EXPECT_LE(worst, 3.0f * 0x1p-11f * brightest);
}

TEST(BakeLightmaps, ThreadsAndStoresChangeNoByteAndStoresSaveTheWork) {
    Scene scene;
    scene.environment.radiance = glm::vec3(0.4f);
    test::add_floor(scene, kGrey, 1.0f);
    test::add_box(scene, kGrey, test::Facing::Outward, {-0.3f, -0.1f, -0.3f}, {0.3f, 0.8f, 0.3f});
    BakeLightmapsSettings settings = settings_with(128);
    settings.bake.thread_count = settings.layout.thread_count = settings.texels.thread_count = 1;
    const auto whole = lightmap_file_bytes(bake(scene, settings).view());
    settings.bake.thread_count = settings.layout.thread_count = settings.texels.thread_count = 3;
    const TempFolder folder;
    auto store = BakeStore::open(folder.path("store"));
    ASSERT_TRUE(store);
    const BakeStorage storage{.sources = {&*store}, .target = &*store, .is_saved_at_end = true};
    EXPECT_EQ(lightmap_file_bytes(bake(scene, settings, storage).view()), whole);
    const auto prepared = prepare_lightmaps(scene, settings);
    ASSERT_TRUE(prepared);
    const auto again = bake_texels(scene, *prepared, storage);
    ASSERT_TRUE(again);
    EXPECT_GT(again->stored.earlier_ray_count, 0u);
    uint64_t rays = 0;
    for (const ProbeAccumulator& sums : again->accumulators) rays += sums.ray_count;
    EXPECT_EQ(rays, again->stored.earlier_ray_count);
}

/// A floor and a box on it under a white sky, which light each other.
Scene box_on_floor() {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, kGrey, 2.0f).name = "floor";
    test::add_box(scene, kGrey, test::Facing::Outward, {-0.5f, -0.1f, -0.5f}, {0.5f, 1, 0.5f});
    return scene;
}

TEST(BakeLightmaps, TexelsOfAnotherCacheAreNotReused) {
    const Scene scene = box_on_floor();
    const TempFolder folder;
    auto store = BakeStore::open(folder.path("store"));
    ASSERT_TRUE(store);
    const BakeStorage storage{.sources = {&*store}, .target = &*store, .is_saved_at_end = true};
    BakeLightmapsSettings settings = settings_with(64);
    const auto earlier_rays = [&](const Scene& lit) {
        const auto prepared = prepare_lightmaps(lit, settings);
        EXPECT_TRUE(prepared);
        const auto baked = bake_texels(lit, *prepared, storage);
        EXPECT_TRUE(baked);
        EXPECT_EQ(baked->cache_seconds > 0.0,
                  prepared->has_cache() && baked->stored.earlier_ray_count == 0);
        return baked->stored.earlier_ray_count;
    };
    EXPECT_EQ(earlier_rays(scene), 0u);
    EXPECT_GT(earlier_rays(scene), 0u);
    settings.is_exact = true;
    EXPECT_EQ(earlier_rays(scene), 0u);
    settings.is_exact = false;
    Scene finer = scene;  // the texels of the floor stay, the cache of the box changes
    finer.instances[1].lightmap.scale = 2.0f;
    EXPECT_EQ(earlier_rays(finer), 0u);
}

TEST(BakeLightmaps, LimitedPathsAreExact) {
    const Scene scene = box_on_floor();
    BakeLightmapsSettings settings = settings_with(64);
    settings.bake.bounces = 3;
    const auto limited = lightmap_file_bytes(bake(scene, settings).view());
    const auto prepared = prepare_lightmaps(scene, settings);
    ASSERT_TRUE(prepared);
    EXPECT_FALSE(prepared->has_cache());
    settings.is_exact = true;
    const Lightmaps exact = bake(scene, settings);
    EXPECT_NE(lightmap_file_bytes(exact.view()), limited);  // the metadata
    settings.is_exact = false;
    const auto light = irradiance_of(bake(scene, settings), 0);
    EXPECT_EQ(light, irradiance_of(exact, 0));
}

TEST(BakeLightmaps, TexelsHaveTheirLightWhateverElseIsBaked) {
    const Scene scene = box_on_floor();
    BakeLightmapsSettings settings = settings_with(64);
    const auto light = irradiance_of(bake(scene, settings), 0);
    settings.only = {"floor"};
    EXPECT_EQ(irradiance_of(bake(scene, settings), 0), light);
    settings.only.clear();
    settings.layout.page_size = 64;
    EXPECT_EQ(irradiance_of(bake(scene, settings), 0), light);
}

TEST(BakeLightmaps, OnlyTheNamedObjectIsBaked) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, kGrey, 1.0f).name = "floor";
    test::add_floor(scene, kGrey, 1.0f, 5.0f).name = "roof";
    BakeLightmapsSettings settings = settings_with(64);
    settings.only = {"roof"};
    const Lightmaps maps = bake(scene, settings);
    EXPECT_TRUE(irradiance_of(maps, 0).empty());
    EXPECT_FALSE(irradiance_of(maps, 1).empty());
    settings.only = {"door"};
    EXPECT_EQ(error_of(scene, settings), "no object \"door\" of the scene takes a lightmap");
}

TEST(BakeLightmaps, WarnsOfObjectsThatStayBlack) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, kGrey, 2.0f).name = "lit";
    test::add_box(scene, kGrey, test::Facing::Outward, {9, 0, 9}, {11, 2, 11});
    test::add_quad(scene, kGrey, {9.5, 1, 9.5}, {0, 0, 1}, {1, 0, 0}).name = "in a box";
    const auto baked = bake_lightmaps(scene, settings_with(1));
    ASSERT_EQ(baked->report.warnings.size(), 1u);
    EXPECT_EQ(baked->report.warnings[0],
              "no light was found for 1 object, which stays black: all its texels are inside "
              "geometry, or its surface has no area (\"in a box\")");
}

TEST(BakeLightmaps, SurfacesWithoutAreaInUvsHaveOneTexel) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, kGrey, 2.0f).name = "on a point";
    Mesh& mesh = scene.meshes.back();
    mesh.uvs[1].assign(mesh.positions.size(), glm::vec2(0.5f));
    BakeLightmapsSettings settings = settings_with(1);
    settings.layout.uvs = LightmapUvs::Keep;
    const auto kept = bake_lightmaps(scene, settings);
    ASSERT_EQ(kept->report.warnings.size(), 1u);
    EXPECT_TRUE(kept->report.warnings[0].starts_with(
        "object \"on a point\": TEXCOORD_1 has no area on 100 % of the surface"));
    EXPECT_EQ(kept->report.baked_count, 1u);
    for (const float value : irradiance_of(kept->lightmaps, 0)) EXPECT_GT(value, 0.0f);
    settings.layout.uvs = LightmapUvs::Repair;
    const auto repaired = bake_lightmaps(scene, settings);
    EXPECT_EQ(repaired->report.warnings.size(), 1u);
    EXPECT_GT(repaired->report.baked_count, 100u);
}

TEST(BakeLightmaps, RefusesPagesThatDoNotFitIntoMemory) {
    Scene scene;
    test::add_floor(scene, kGrey, 500.0f);
    scene.instances.resize(1000, scene.instances[0]);
    BakeLightmapsSettings settings = settings_with(1, 9.0);
    settings.layout.page_size = 16384;
    EXPECT_TRUE(error_of(scene, settings).find("pages of 16384 x 16384 texels need about ") !=
                std::string::npos);
}

TEST(BakeLightmaps, ObjectsThatAreLeftOutDarkenNoSeam) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_quad(scene, kGrey, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}).name = "tile";
    test::add_quad(scene, kGrey, {1, 0, 0}, {0, 0, 1}, {1, 0, 0}).name = "next";
    BakeLightmapsSettings settings = settings_with(256);
    settings.only = {"tile"};
    for (const float value : irradiance_of(bake(scene, settings), 0))
        EXPECT_NEAR(double{value}, kPi, 0.03);
}

TEST(BakeLightmaps, SeamsAreStitchedUnlessAnObjectForbidsIt) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_quad(scene, kGrey, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
    test::add_quad(scene, kGrey, {1, 0, 0}, {0, 0, 1}, {1, 0, 0});
    EXPECT_EQ(prepare_lightmaps(scene, settings_with(1))->seams.size(), 1u);
    scene.instances[1].lightmap.stitches_seams = false;
    EXPECT_EQ(prepare_lightmaps(scene, settings_with(1))->seams.size(), 0u);
}

TEST(BakeLightmaps, RefusesWhatTexelsCannotHave) {
    Scene scene;
    test::add_floor(scene, kGrey, 1.0f);
    BakeLightmapsSettings settings = settings_with(64);
    settings.lighting.layers = {"transfer"};
    EXPECT_EQ(error_of(scene, settings), "layers: lightmaps have no transfer of distant light");
    scene.instances[0].lightmap.receive_gi = ReceiveGi::Probes;
    EXPECT_EQ(error_of(scene, settings_with(64)), "the scene has no object that takes a lightmap");
}

TEST(BakeLightmaps, ATimeBudgetGivesTheBytesOfItsNumberOfSamples) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, kGrey, 2.0f);
    test::add_box(scene, kGrey, test::Facing::Outward, {-1, 0.1f, -1}, {1, 1, 1});
    for (const double target : {0.0, 0.05}) {
        for (const double seconds : {1e-9, 1e9}) {
            BakeLightmapsSettings settings = settings_with(128);
            settings.bake.target_error = target;
            settings.bake.max_sample_count = 512;
            settings.bake.time_budget_seconds = seconds;
            const Lightmaps in_time = bake(scene, settings);
            settings.bake.time_budget_seconds = 0.0;
            settings.bake.max_sample_count = seconds < 1.0 ? 128 : 512;
            EXPECT_TRUE(bake(scene, settings) == in_time) << target << " " << seconds;
        }
    }
}

TEST(BakeLightmaps, RecordsTheSamplesOfATimeBudgetInsteadOfTheTime) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, kGrey, 1.0f);
    BakeLightmapsSettings settings = settings_with(128);
    settings.bake.time_budget_seconds = 1e-9;
    const std::string metadata = bake(scene, settings).metadata;
    EXPECT_NE(metadata.find("\"max_samples\":128"), std::string::npos) << metadata;
    EXPECT_EQ(metadata.find("time_budget"), std::string::npos) << metadata;
}

}  // namespace
}  // namespace tetralight
