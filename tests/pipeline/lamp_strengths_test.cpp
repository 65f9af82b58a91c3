// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lamp_strengths.h>

#include <gtest/gtest.h>

#include <tetralight/base/error_text.h>
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

class LampStrengthsTest : public testing::Test {
  protected:
    LampStrengthsTest() {
        test::add_point_light(scene, LightMode::Baked, {3, 2, 1}, {0.5f, 1.5f, 0.5f});
        test::add_point_light(scene, LightMode::Mixed, {4, 8, 4}, {0.5f, 0.5f, 0.5f});
        scene.light_names = {"lamp", "other"};
        scene.environment.radiance = {1, 1, 1};
    }

    [[nodiscard]] LampStrengths strengths(const std::vector<std::string>& layers) const {
        auto result = lamp_strengths(scene, {.layers = layers});
        EXPECT_TRUE(result) << error_text(result.error());
        return *result;
    }

    Scene scene;
};

TEST_F(LampStrengthsTest, AreThoseOfLayersOfLightsAlone) {
    const LampStrengths found = strengths({"light:lamp", "sky"});
    EXPECT_EQ(found.strengths, (std::map<std::string, double>{{"light:lamp", 3.0}}));
}

TEST_F(LampStrengthsTest, TheKeyIsThatOfAllElse) {
    const std::vector<std::string> layers{"light:lamp"};
    const LampStrengths before = strengths(layers);
    scene.lights[0].intensity *= 1.3f;
    const LampStrengths stronger = strengths(layers);
    EXPECT_EQ(stronger.scene_key, before.scene_key);
    EXPECT_NEAR(stronger.strengths.at("light:lamp"), 3.9, 1e-6);
    scene.lights[0].intensity.g *= 1.1f;  // another colour
    EXPECT_NE(strengths(layers).scene_key, before.scene_key);
    scene.lights[0].intensity = {3, 2, 1};
    EXPECT_EQ(strengths(layers).scene_key, before.scene_key);
    scene.lights[1].intensity *= 2.0f;  // in no layer
    EXPECT_NE(strengths(layers).scene_key, before.scene_key);
    scene.lights[1].intensity *= 0.5f;
    scene.lights[0].position.x += 1.0f;
    EXPECT_NE(strengths(layers).scene_key, before.scene_key);
}

TEST_F(LampStrengthsTest, LightsOfOneLayerChangeTogether) {
    scene.light_names = {"lamp", "lamp"};
    const std::vector<std::string> layers{"light:lamp"};
    const LampStrengths before = strengths(layers);
    EXPECT_EQ(before.strengths.at("light:lamp"), 8.0);
    for (Light& light : scene.lights) light.intensity *= 0.5f;
    EXPECT_EQ(strengths(layers).scene_key, before.scene_key);
    scene.lights[0].intensity *= 2.0f;
    EXPECT_NE(strengths(layers).scene_key, before.scene_key);
}

TEST_F(LampStrengthsTest, DarkLayersHaveNone) {
    scene.lights[0].intensity = {0, 0, 0};
    EXPECT_TRUE(strengths({"light:lamp"}).strengths.empty());
    EXPECT_FALSE(lamp_strengths(scene, {.layers = {"light:none"}}));
}

}  // namespace
}  // namespace tetralight
