// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/relight_lightmaps.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <tetralight/base/error_text.h>
#include <tetralight/lightmap/lightmap_file.h>
#include "tests/lightmap/lightmap_fixture.h"

namespace tetralight {
namespace {

Status relight(Lightmaps& lightmaps, std::vector<LayerWeight> changes) {
    return relight_lightmaps(lightmaps, changes);
}

float irradiance_at(const Lightmaps& lightmaps, size_t texel, size_t channel) {
    return float_from_half(lightmaps.irradiance[texel].rgb[channel]) * lightmaps.info.scale;
}

float layer_at(const Lightmaps& lightmaps, size_t layer, size_t texel, size_t channel) {
    const size_t first = layer * lightmaps.irradiance.size();
    return float_from_half(lightmaps.layer_irradiance[first + texel].rgb[channel]) *
           lightmaps.layers[layer].scale;
}

TEST(RelightLightmaps, IsTheWeightedSumOfTheLayers) {
    Lightmaps lightmaps = test::make_full_lightmaps();
    ASSERT_TRUE(relight(lightmaps, {{"sky", 0.5f}, {"lamp", 3.0f}}));
    EXPECT_TRUE(verify(lightmaps.view()));
    EXPECT_EQ(lightmaps.layers[0].weight, 0.5f);
    EXPECT_EQ(lightmaps.layers[1].weight, 3.0f);
    for (size_t i = 0; i < lightmaps.irradiance.size(); ++i) {
        for (size_t c = 0; c < 3; ++c) {
            const float sum =
                0.5f * layer_at(lightmaps, 0, i, c) + 3.0f * layer_at(lightmaps, 1, i, c);
            EXPECT_NEAR(irradiance_at(lightmaps, i, c), sum, 0x1p-11f * sum);
        }
    }
}

TEST(RelightLightmaps, RewritesTheLightForNormalMapsToo) {
    Lightmaps lightmaps = test::make_full_lightmaps();
    const std::vector<LightmapTexel> lamp(lightmaps.layer_light.begin() + 32,
                                          lightmaps.layer_light.end());
    ASSERT_TRUE(relight(lightmaps, {{"sky", 0.0f}}));
    EXPECT_EQ(lightmaps.light, lamp);
}

TEST(RelightLightmaps, BackToTheFirstWeightsGivesTheFirstBytes) {
    const Lightmaps baked = test::make_full_lightmaps();
    Lightmaps lightmaps = baked;
    for (int i = 0; i < 20; ++i) {
        ASSERT_TRUE(relight(lightmaps, {{"lamp", 0.0f}}));
        ASSERT_TRUE(relight(lightmaps, {{"lamp", 1.0f}}));
    }
    EXPECT_EQ(lightmaps, baked);
}

TEST(RelightLightmaps, TheSameWeightsChangeNothing) {
    const Lightmaps baked = test::make_full_lightmaps();
    Lightmaps lightmaps = baked;
    ASSERT_TRUE(relight(lightmaps, {{"lamp", 1.0f}}));
    EXPECT_EQ(lightmaps, baked);
}

/// One texel with a bright lamp over dim light.
Lightmaps make_dim_texel(float dim, float bright) {
    Lightmaps lightmaps = test::make_black_page(1);
    lightmaps.irradiance[0] = test::texel_of(glm::vec3(dim + bright));
    lightmaps.layers.resize(2);
    lightmaps.layer_names = "sky\nlight:lamp\n";
    lightmaps.layer_irradiance = {{test::texel_of(glm::vec3(dim)).rgb},
                                  {test::texel_of(glm::vec3(bright)).rgb}};
    return lightmaps;
}

TEST(RelightLightmaps, SwitchingOffABrightLightLeavesThePreciseRest) {
    Lightmaps lightmaps = make_dim_texel(0.125f, 4095.0f);  // the sum is rounded to 4096
    ASSERT_TRUE(relight(lightmaps, {{"lamp", 0.0f}}));
    EXPECT_EQ(irradiance_at(lightmaps, 0, 0), 0.125f);
}

TEST(RelightLightmaps, KeepsLightThatIsInNoLayer) {
    Lightmaps lightmaps = make_dim_texel(2.0f, 6.0f);
    lightmaps.irradiance[0] = test::texel_of(glm::vec3(10.0f));
    ASSERT_TRUE(relight(lightmaps, {{"lamp", 0.5f}}));
    EXPECT_EQ(irradiance_at(lightmaps, 0, 1), 2.0f + 2.0f + 3.0f);
}

TEST(RelightLightmaps, IsNeverNegative) {
    Lightmaps lightmaps = make_dim_texel(2.0f, 6.0f);
    lightmaps.irradiance[0] = test::texel_of(glm::vec3(1.0f));  // less than its layers
    ASSERT_TRUE(relight(lightmaps, {{"lamp", 0.0f}}));
    EXPECT_EQ(irradiance_at(lightmaps, 0, 0), 0.0f);
}

TEST(RelightLightmaps, RaisesTheScaleForBrighterLight) {
    Lightmaps lightmaps = make_dim_texel(1.0f, 1024.0f);
    ASSERT_TRUE(relight(lightmaps, {{"lamp", 1024.0f}}));
    EXPECT_TRUE(verify(lightmaps.view()));
    const float sum = 1.0f + 1024.0f * 1024.0f;
    EXPECT_NEAR(irradiance_at(lightmaps, 0, 0), sum, 0x1p-11f * sum);
    EXPECT_EQ(lightmaps.info.scale, 64.0f);
}

TEST(RelightLightmaps, RemovesLightWithoutLayers) {
    Lightmaps lightmaps = test::make_full_lightmaps();
    lightmaps.layer_light.clear();
    ASSERT_TRUE(relight(lightmaps, {{"lamp", 2.0f}}));
    EXPECT_TRUE(lightmaps.light.empty());
}

TEST(RelightLightmaps, NamesLayersThatItDoesNotKnow) {
    Lightmaps lightmaps = test::make_full_lightmaps();
    const Status status = relight(lightmaps, {{"neon", 2.0f}});
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::NotFound);
    EXPECT_EQ(status.error().value, "neon");
    EXPECT_EQ(error_text(status.error()),
              "there is no layer \"neon\"; it holds \"sky\", \"light:lamp\"");
}

TEST(RelightLightmaps, RefusesWeightsAndChangesNothing) {
    const Lightmaps baked = test::make_full_lightmaps();
    Lightmaps lightmaps = baked;
    for (const float weight : {-1.0f, std::nanf(""), INFINITY, 1e30f}) {
        const Status status = relight(lightmaps, {{"lamp", weight}});
        ASSERT_FALSE(status) << weight;
        EXPECT_EQ(status.error().code, ErrorCode::InvalidArgument);
        EXPECT_EQ(status.error().field, "weights");
    }
    EXPECT_EQ(lightmaps, baked);
}

TEST(RelightLightmaps, RefusesMissingTexelsOfLayers) {
    Lightmaps lightmaps = test::make_full_lightmaps();
    lightmaps.layer_irradiance.clear();
    const Status status = relight(lightmaps, {{"lamp", 2.0f}});
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::Corrupt);
    EXPECT_EQ(status.error().field, "layer_irradiance");
}

}  // namespace
}  // namespace tetralight
