// SPDX-License-Identifier: Apache-2.0
// Shadow masks, subtractive lightmaps and ambient occlusion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tetralight/bake/occlusion.h>
#include <tetralight/base/error_text.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

const Material kGrey = test::diffuse(glm::vec3(0.5f));

BakeLightmapsSettings settings_with(MixedLighting mode, uint32_t samples = 16) {
    BakeLightmapsSettings settings;
    settings.layout.texels_per_meter = 4.0;
    settings.layout.page_size = 128;
    settings.bake.sample_count = samples;
    settings.lighting.mixed_lighting = mode;
    return settings;
}

PreparedLightmaps prepare(const Scene& scene, const BakeLightmapsSettings& settings) {
    auto prepared = prepare_lightmaps(scene, settings);
    EXPECT_TRUE(prepared) << error_text(prepared.error());
    return std::move(*prepared);
}

Lightmaps bake(const Scene& scene, const BakeLightmapsSettings& settings) {
    auto baked = bake_lightmaps(scene, settings);
    EXPECT_TRUE(baked) << error_text(baked.error());
    EXPECT_TRUE(verify(baked->lightmaps.view()));
    return std::move(baked->lightmaps);
}

/// A floor of 4 m x 4 m, of which a roof at a height of 2 m hides x > 0 from the mixed sun above.
Scene half_roofed_floor(float sun_angle = 0.0f) {
    Scene scene;
    test::add_floor(scene, kGrey, 2.0f);
    test::add_quad(scene, kGrey, {0, 2, -20}, {40, 0, 0}, {0, 0, 40}).lightmap.scale = 0.0f;
    test::add_sun(scene, LightMode::Mixed, glm::vec3(3.0f));
    scene.lights[0].direction = {0, -1, 0};
    scene.lights[0].radius = sun_angle;
    return scene;
}

/// Calls `visit(index in the pages, texel)` for each baked texel.
template <class Visit>
void for_each_texel(const PreparedLightmaps& prepared, const Visit& visit) {
    const std::vector<size_t> indices = prepared.page_texels();
    for (size_t i = 0; i < indices.size(); ++i) visit(indices[i], prepared.baked[i]);
}

TEST(LightmapOcclusion, AMaskHoldsTheShadowsOfStaticObjects) {
    const Scene scene = half_roofed_floor();
    const BakeLightmapsSettings settings = settings_with(MixedLighting::Shadowmask);
    const Lightmaps maps = bake(scene, settings);
    EXPECT_EQ(maps.info.mixed_lighting, MixedLighting::Shadowmask);
    size_t lit = 0, dark = 0;
    const PreparedLightmaps prepared = prepare(scene, settings);
    for_each_texel(prepared, [&](size_t index, uint32_t texel) {
        const double x = prepared.texels.positions[texel].x;
        if (std::abs(x) < 0.3) return;  // at the edge
        const ShadowMaskTexel expected{static_cast<uint8_t>(x < 0 ? 255 : 0), 255, 255, 255};
        EXPECT_EQ(maps.shadow_mask[index], expected) << x;
        (x < 0 ? lit : dark) += 1;
    });
    EXPECT_GT(lit, 30u);
    EXPECT_GT(dark, 30u);
    EXPECT_NE(maps.metadata.find(R"("shadow_mask":[{"light":"light","channel":0}])"),
              std::string::npos)
        << maps.metadata;
    // The light itself is that without the mask.
    const Lightmaps indirect = bake(scene, settings_with(MixedLighting::Indirect));
    EXPECT_TRUE(indirect.shadow_mask.empty());
    EXPECT_EQ(maps.irradiance, indirect.irradiance);
}

TEST(LightmapOcclusion, AMaskIsTheOcclusionOfProbesAtItsPlaces) {
    const Scene scene = half_roofed_floor(0.2f);
    BakeLightmapsSettings settings = settings_with(MixedLighting::Shadowmask);
    settings.texels.grid = 1;
    const Lightmaps maps = bake(scene, settings);
    const PreparedLightmaps prepared = prepare(scene, settings);
    const TraceScene traced = *TraceScene::make_static(scene);
    const PathTracer tracer(scene, traced, {});
    const Light sun = traced.render_from_world(scene.lights[0]);
    size_t penumbra = 0;
    for_each_texel(prepared, [&](size_t index, uint32_t texel) {
        const TexelSurface surface = prepared.texels.view()[texel];
        ASSERT_EQ(surface.origins.size(), 1u);
        const glm::vec3 origin =
            traced.render_from_world(prepared.texels.positions[texel]) + surface.origins[0];
        const double probe = double{light_visibility(tracer, sun, origin, texel)};
        const double mask = maps.shadow_mask[index][0] / 255.0;
        // Both have a variance of p (1 - p) / rays.
        const double sigma = std::sqrt(2.0 * probe * (1.0 - probe) / kOcclusionRayCount);
        EXPECT_NEAR(mask, probe, std::max(4.0 * sigma, 1.01 / 255.0));
        penumbra += mask > 0.1 && mask < 0.9;
    });
    EXPECT_GT(penumbra, 10u);
}

TEST(LightmapOcclusion, SubtractiveTexelsHoldTheLightOfMixedLights) {
    Scene scene = half_roofed_floor();
    const Lightmaps subtractive = bake(scene, settings_with(MixedLighting::Subtractive));
    EXPECT_TRUE(subtractive.shadow_mask.empty());
    EXPECT_EQ(subtractive.info.mixed_lighting, MixedLighting::Subtractive);
    scene.lights[0].mode = LightMode::Baked;
    EXPECT_EQ(subtractive.irradiance,
              bake(scene, settings_with(MixedLighting::Indirect)).irradiance);
}

TEST(LightmapOcclusion, AmbientOcclusionIsAMapOfItsOwn) {
    // Beside an endless wall the cosine-weighted part of the hemisphere in which it is nearer than
    // 1 m is a segment of the unit disc.
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_floor(scene, kGrey, 2.0f);
    Material two_sided = kGrey;
    two_sided.is_double_sided = true;
    test::add_quad(scene, two_sided, {0.51f, -5, -50}, {0, 0, 100}, {0, 50, 0}).lightmap.scale = 0;
    BakeLightmapsSettings settings = settings_with(MixedLighting::Indirect);
    settings.bake.sample_count = 64;
    const Lightmaps plain = bake(scene, settings);
    EXPECT_TRUE(plain.ambient_occlusion.empty());
    settings.ambient_occlusion_distance = 1.0f;
    settings.texels.grid = 1;
    const Lightmaps maps = bake(scene, settings);
    EXPECT_EQ(maps.info.ambient_occlusion_distance, 1.0f);
    const PreparedLightmaps prepared = prepare(scene, settings);
    size_t near = 0;
    for_each_texel(prepared, [&](size_t index, uint32_t texel) {
        const glm::dvec3 place =
            prepared.texels.positions[texel] + glm::dvec3(prepared.texels.view()[texel].origins[0]);
        const double r = std::abs(place.x - 0.51);
        const double blocked =
            r < 1.0 ? (std::acos(r) - r * std::sqrt(1.0 - r * r)) / std::numbers::pi : 0.0;
        EXPECT_NEAR(maps.ambient_occlusion[index] / 255.0, 1.0 - blocked, 0.02) << place.x;
        near += r < 0.8;
    });
    EXPECT_GT(near, 50u);
    settings.ambient_occlusion_distance = 0.0f;
    EXPECT_EQ(maps.irradiance, bake(scene, settings).irradiance);
}

TEST(LightmapOcclusion, TexelsInsideGeometryTakeThatOfTexelsAround) {
    Scene scene = half_roofed_floor();
    test::add_box(scene, kGrey, test::Facing::Outward, {-1.5f, -0.2f, -0.5f}, {-0.5f, 0.01f, 0.5f});
    BakeLightmapsSettings settings = settings_with(MixedLighting::Shadowmask);
    const Lightmaps maps = bake(scene, settings);
    const LightmapRectangle& floor = maps.rectangles[0];
    for (uint32_t y = floor.y; y < floor.y + floor.height; ++y) {
        for (uint32_t x = floor.x; x < floor.x + floor.width; ++x) {
            const size_t index = y * size_t{maps.info.page_size} + x;
            if (maps.irradiance[index].coverage == 0) continue;
            EXPECT_EQ(maps.shadow_mask[index][1], 255) << x << " " << y;
        }
    }
}

}  // namespace
}  // namespace tetralight
