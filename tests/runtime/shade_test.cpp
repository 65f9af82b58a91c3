// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/shade.h>

#include <gtest/gtest.h>

#include <numbers>

namespace tetralight {
namespace {

TEST(Shade, UnderConstantLightASurfaceShowsItsAlbedo) {
    // Exitant radiance = albedo/π · π · L.
    const PackedSh sh = pack_sh(irradiance_from_radiance(constant_radiance(glm::vec3(2.0f))));
    const glm::vec3 seen = shade_diffuse({0.1f, 0.5f, 1.0f}, sh, {0, 1, 0}, glm::vec3(0.0f));
    EXPECT_NEAR(seen.x, 0.2f, 1e-6f);
    EXPECT_NEAR(seen.y, 1.0f, 1e-6f);
    EXPECT_NEAR(seen.z, 2.0f, 1e-6f);
}

TEST(Shade, NegativeProbeLightCountsAsNone) {
    const PackedSh sh = pack_sh(irradiance_from_radiance(constant_radiance(glm::vec3(-1.0f))));
    EXPECT_EQ(shade_diffuse(glm::vec3(1.0f), sh, {0, 1, 0}, glm::vec3(0.5f)), glm::vec3(0.5f));
}

TEST(Shade, DirectLightFollowsTheCosine) {
    Light sun;
    sun.direction = {0.0f, -1.0f, 0.0f};
    sun.intensity = glm::vec3(std::numbers::pi_v<float>);
    EXPECT_NEAR(direct_light(sun, {}, {0, 1, 0}).x, 1.0f, 1e-6f);
    EXPECT_NEAR(direct_light(sun, {}, {0.6f, 0.8f, 0}).x, 0.8f, 1e-6f);
    EXPECT_EQ(direct_light(sun, {}, {0, -1, 0}), glm::vec3(0.0f));
}

TEST(Shade, SubtractedShadowsEndAtTheShadowColor) {
    const glm::vec3 direct(1.0f), shadow(0.4f);
    // Lit: the light goes, and what is left is brighter than the color of shadows.
    EXPECT_EQ(subtract_shadow(glm::vec3(1.5f), direct, 1.0f, shadow), glm::vec3(1.5f));
    EXPECT_EQ(subtract_shadow(glm::vec3(1.5f), direct, 0.0f, shadow), glm::vec3(0.5f));
    EXPECT_EQ(subtract_shadow(glm::vec3(1.5f), direct, 0.5f, shadow), glm::vec3(1.0f));
    // Penumbra of a baked shadow: no darker than the color.
    EXPECT_EQ(subtract_shadow(glm::vec3(0.8f), direct, 0.0f, shadow), shadow);
    // In a baked shadow that is darker than the color nothing changes.
    EXPECT_EQ(subtract_shadow(glm::vec3(0.2f), direct, 0.0f, shadow), glm::vec3(0.2f));
}

}  // namespace
}  // namespace tetralight
