// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/lighting_plan.h>

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// A sun, two lamps of which one is realtime, two materials that shine, a sky.
Scene make_scene() {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 1.0f);
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f), {1, 0, 0}), 1.0f);
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f), {0, 1, 0}), 1.0f);
    scene.materials[0].name = "plaster";
    scene.materials[1].name = "neon";
    scene.materials[2].name = "lava";
    test::add_sun(scene, LightMode::Mixed, glm::vec3(3.0f));
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(1.0f), {0, 1, 0});
    test::add_point_light(scene, LightMode::Realtime, glm::vec3(1.0f), {1, 1, 0});
    scene.light_names = {"sun", "lamp", "torch"};
    scene.environment.radiance = glm::vec3(1.0f);
    return scene;
}

LightingPlan plan_of(const std::vector<std::string>& layers, const Scene& scene = make_scene()) {
    auto plan = plan_lighting(scene, {MixedLighting::Indirect, layers});
    EXPECT_TRUE(plan) << error_text(plan.error());
    return plan ? std::move(*plan) : LightingPlan{};
}

std::string error_of(const std::vector<std::string>& layers) {
    const auto plan = plan_lighting(make_scene(), {MixedLighting::Indirect, layers});
    EXPECT_FALSE(plan);
    return plan ? "" : error_text(plan.error());
}

using Names = std::vector<std::string>;
using Layers = std::vector<uint32_t>;
constexpr uint32_t kNone = kNoIndex;

TEST(LightingPlan, WithoutLayersSplitsNothing) {
    const LightingPlan plan = plan_of({});
    EXPECT_FALSE(plan.bake.has_light_groups());
    EXPECT_FALSE(plan.bake.has_occlusion);
    EXPECT_TRUE(plan.layer_names.empty());
    EXPECT_EQ(plan.lights, make_scene().lights);
}

TEST(LightingPlan, GivesEachSourceItsLayer) {
    const LightingPlan plan = plan_of({"sun", "sky", "light:lamp", "material:neon"});
    EXPECT_EQ(plan.layer_names, (Names{"sun", "sky", "light:lamp", "material:neon", "rest"}));
    EXPECT_EQ(plan.bake.layer_of_light, (Layers{0, 2, kNone}));
    EXPECT_EQ(plan.bake.layer_of_material, (Layers{kNone, 3, kNone}));
    EXPECT_EQ(plan.bake.layer_of_sky, 1u);
    EXPECT_TRUE(plan.has_rest());  // lava
    EXPECT_TRUE(plan.warnings.empty());
}

TEST(LightingPlan, NamesWinOverKinds) {
    const LightingPlan plan = plan_of({"emission", "sun", "light:sun", "material:neon"});
    EXPECT_EQ(plan.bake.layer_of_light, (Layers{2, kNone, kNone}));
    EXPECT_EQ(plan.bake.layer_of_material, (Layers{0, 3, 0}));
    EXPECT_EQ(plan.warnings, Names{"layer \"sun\" is dark: nothing in the scene lights it"});
}

TEST(LightingPlan, RestIsThereWhenSomethingIsLeft) {
    EXPECT_FALSE(plan_of({"sun", "sky", "emission", "light:lamp"}).has_rest());
    EXPECT_TRUE(plan_of({"sun", "sky", "emission"}).has_rest());
    const LightingPlan plan = plan_of({"sky"});
    EXPECT_EQ(plan.light_states[0].layer, 1u);  // the rest
    EXPECT_EQ(plan.light_states[1].layer, 1u);
    EXPECT_EQ(plan.light_states[2].layer, kNone);  // nothing of it is baked
}

TEST(LightingPlan, TransferBringsTheSkyAlong) {
    EXPECT_EQ(plan_of({"sun", "transfer"}).layer_names, (Names{"sun", "sky", "rest"}));
    EXPECT_EQ(plan_of({"transfer", "sky"}).layer_names, (Names{"sky", "rest"}));
    EXPECT_TRUE(plan_of({"transfer"}).bake.has_transfer);
    EXPECT_FALSE(plan_of({"sky"}).bake.has_transfer);
}

TEST(LightingPlan, RefusesWhatTheSceneDoesNotHave) {
    EXPECT_EQ(error_of({"moon"}),
              "layer \"moon\" is none of sun, sky, emission, transfer, light:NAME, material:NAME");
    EXPECT_EQ(error_of({"light:"}),
              "layer \"light:\" is none of sun, sky, emission, transfer, light:NAME, "
              "material:NAME");
    EXPECT_EQ(error_of({"light:lantern"}),
              "layer \"light:lantern\": the scene has no such light; it has \"lamp\", \"sun\", "
              "\"torch\"");
    EXPECT_EQ(error_of({"material:gold"}),
              "layer \"material:gold\": the scene has no such material; emissive materials are "
              "\"lava\", \"neon\"");
    EXPECT_EQ(error_of({"light:torch"}),
              "layer \"light:torch\": the light is realtime and is not baked");
    EXPECT_EQ(error_of({"sky", "sun", "sky"}), "layer \"sky\" is listed twice");
}

TEST(LightingPlan, ShadowmaskGivesChannelsToMixedLights) {
    const auto plan = plan_lighting(make_scene(), {MixedLighting::Shadowmask, {}});
    ASSERT_TRUE(plan);
    EXPECT_TRUE(plan->bake.has_occlusion);
    EXPECT_EQ(plan->light_states[0].channel, 0u);
    EXPECT_EQ(plan->light_states[1].channel, 1u);
    EXPECT_EQ(plan->light_states[2].channel, kNone);
    EXPECT_EQ(plan->light_states[0].mixed_lighting, MixedLighting::Shadowmask);
}

TEST(LightingPlan, TheFifthOverlappingLightIsBakedWithAWarning) {
    Scene scene;
    for (int i = 0; i < 5; ++i) {
        test::add_point_light(scene, LightMode::Mixed, glm::vec3(5.0f - static_cast<float>(i)),
                              {i, 0, 0});
        scene.light_names[static_cast<size_t>(i)] = "lamp " + std::to_string(i);
    }
    const auto plan = plan_lighting(scene, {MixedLighting::Shadowmask, {}});
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->lights[3].mode, LightMode::Mixed);
    EXPECT_EQ(plan->lights[4].mode, LightMode::Baked);
    EXPECT_EQ(plan->bake.light_modes[4], LightMode::Baked);
    EXPECT_EQ(plan->light_states[4].fell_back, 1u);
    ASSERT_EQ(plan->warnings.size(), 1u);
    EXPECT_EQ(plan->warnings[0].find("light \"lamp 4\": all four occlusion channels are taken"),
              0u);
}

}  // namespace
}  // namespace tetralight
