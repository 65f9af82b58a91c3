// SPDX-License-Identifier: Apache-2.0
// What goes into probes in each combination of light mode and mixed-lighting mode, by
// superposition: light is additive.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/probe_groups.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

const std::vector<glm::dvec3> kProbes = {
    {0.3, 1.0, 0.2}, {-1.5, 0.5, 0.4}, {1.2, 1.8, -0.7}, {0.4, 0.3, 1.6}, {-0.8, 2.2, -1.1}};

/// A room with one open side, a screen that shines and a wall inside.
Scene room() {
    Scene scene;
    test::add_floor(scene, test::diffuse({0.7f, 0.5f, 0.3f}), 3.0f);
    test::add_quad(scene, test::diffuse(glm::vec3(0.6f)), {-3, 0, -3}, {6, 0, 0}, {0, 4, 0});
    test::add_box(scene, test::diffuse({0.3f, 0.6f, 0.8f}), test::Facing::Outward, {-0.6f, 0, 0.6f},
                  {-0.3f, 1.5f, 1.2f});
    return scene;
}

Scene with_sky_and_emission() {
    Scene scene = room();
    scene.environment.radiance = {0.2f, 0.3f, 0.5f};
    test::add_quad(scene, test::diffuse(glm::vec3(0.2f), {2, 1, 0.5f}), {-1, 1, -2.9f}, {1, 0, 0},
                   {0, 1, 0});
    return scene;
}

Scene with_lamp(Scene scene, LightMode mode) {
    test::add_point_light(scene, mode, {9, 8, 7}, {0.5f, 2.5f, 0.5f});
    return scene;
}

ProbeVolume bake(const Scene& scene, MixedLighting mode, uint32_t bounces = 3) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = 2048;
    settings.bake.bounces = bounces;
    settings.lighting.mixed_lighting = mode;
    const std::vector<ProbeGroup> groups{test::make_group("probes", kProbes)};
    auto baked = bake_volume(scene, groups, settings);
    EXPECT_TRUE(baked) << error_text(baked.error());
    EXPECT_TRUE(verify(baked->volume.view()));
    return std::move(baked->volume);
}

/// By five standard errors of 2048 directions, which are below 2 % here.
void expect_sum(const ProbeVolume& whole, const std::vector<const ProbeVolume*>& parts) {
    for (size_t i = 0; i < whole.irradiance.size(); ++i) {
        IrradianceSh sum;
        for (const ProbeVolume* part : parts) sum += part->irradiance[i];
        const float tolerance = 0.05f * whole.irradiance[i].coefficients[0].x;
        for (int k = 0; k < kShCoefficientCount; ++k) {
            const glm::vec3 difference = whole.irradiance[i].coefficients[k] - sum.coefficients[k];
            EXPECT_LT(glm::length(difference), tolerance) << i << ' ' << k;
        }
    }
}

TEST(MixedLightingBake, NineCombinationsBySuperposition) {
    const ProbeVolume always = bake(with_sky_and_emission(), MixedLighting::Indirect);
    // A lamp alone: without bounces its direct light, else both.
    const Scene lamp = with_lamp(room(), LightMode::Baked);
    const ProbeVolume direct = bake(lamp, MixedLighting::Indirect, 0);
    const ProbeVolume both = bake(lamp, MixedLighting::Indirect);
    ProbeVolume bounces = both;
    for (size_t i = 0; i < bounces.irradiance.size(); ++i) {
        bounces.irradiance[i] += -1.0f * direct.irradiance[i];
        EXPECT_GT(bounces.irradiance[i].coefficients[0].x, 0.3f);  // what is told apart is there
        EXPECT_GT(direct.irradiance[i].coefficients[0].x, 0.3f);
        EXPECT_GT(always.irradiance[i].coefficients[0].x, 0.3f);
    }
    for (const MixedLighting mode :
         {MixedLighting::Indirect, MixedLighting::Shadowmask, MixedLighting::Subtractive}) {
        SCOPED_TRACE(name_of(mode));
        const auto baked = [&](LightMode light) {
            return bake(with_lamp(with_sky_and_emission(), light), mode);
        };
        const ProbeVolume realtime = baked(LightMode::Realtime);
        expect_sum(realtime, {&always});
        EXPECT_TRUE(realtime.occlusion.empty());
        const ProbeVolume mixed = baked(LightMode::Mixed);
        expect_sum(mixed, {&always, &bounces});
        EXPECT_EQ(mixed.occlusion.empty(), mode == MixedLighting::Indirect);
        const ProbeVolume fully = baked(LightMode::Baked);
        expect_sum(fully, {&always, &direct, &bounces});
        EXPECT_TRUE(fully.occlusion.empty());
    }
}

TEST(MixedLightingBake, OcclusionKnowsWhichLightItIsOf) {
    Scene scene = with_lamp(room(), LightMode::Mixed);
    // The box between −0.6 and −0.3 hides the lamp from what is behind it.
    BakeVolumeSettings settings;
    settings.bake.sample_count = 32;
    settings.lighting.mixed_lighting = MixedLighting::Shadowmask;
    const std::vector<ProbeGroup> groups{
        test::make_group("probes", {{1, 1, 1}, {-1.0, 0.2, 0.9}, {-1, 2.4, 0.9}, {0, 1, 2}})};
    const auto baked = bake_volume(scene, groups, settings);
    ASSERT_TRUE(baked) << error_text(baked.error());
    const ProbeVolume& volume = baked->volume;
    ASSERT_EQ(volume.occlusion.size(), 4u);
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(volume.occlusion_lights[i], (OcclusionLights{0, kNoIndex, kNoIndex, kNoIndex}));
        const bool is_hidden = volume.exact_positions[i].y == 0.2;
        EXPECT_EQ(volume.occlusion[i], glm::vec4(is_hidden ? 0.0f : 1.0f, 1, 1, 1)) << i;
    }
    EXPECT_NE(volume.metadata.find("\"mixed_lighting\":\"shadowmask\""), std::string::npos);
}

TEST(MixedLightingBake, AFifthLightsDirectLightReallyIsInTheProbes) {
    Scene scene;
    for (int i = 0; i < 5; ++i) {
        test::add_point_light(scene, LightMode::Mixed, glm::vec3(i == 2 ? 1.0f : 5.0f),
                              {static_cast<float>(i), 3, 0});
    }
    const ProbeVolume volume = bake(scene, MixedLighting::Shadowmask);
    EXPECT_EQ(volume.lights[2].mode, LightMode::Baked);
    Scene alone;
    test::add_point_light(alone, LightMode::Baked, glm::vec3(1.0f), {2, 3, 0});
    const ProbeVolume expected = bake(alone, MixedLighting::Indirect);
    for (size_t i = 0; i < kProbes.size(); ++i) {
        EXPECT_EQ(volume.irradiance[i], expected.irradiance[i]);
        EXPECT_EQ(volume.occlusion_lights[i][3] == kNoIndex, false);
    }
}

}  // namespace
}  // namespace tetralight
