// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/lightmap_texture.h>

#include <gtest/gtest.h>

#include "tests/lightmap/lightmap_fixture.h"

namespace tetralight {
namespace {

TEST(LightTexture, HasThreeLayersAPage) {
    const Lightmaps lightmaps = test::make_full_lightmaps();
    const auto texture = make_light_texture(lightmaps.view());
    ASSERT_EQ(texture.size(), 3u * 2 * 16);
    // Page 1, blue, texel 5.
    const LightmapTexel& texel = lightmaps.light[16 + 5];
    const auto& [x, y, z] = texel.vector[2];
    EXPECT_EQ(texture[(3 * 1 + 2) * 16 + 5], (TextureHalves{x, y, z, texel.flux[2]}));
}

TEST(LightTexture, IsEmptyWithoutLight) {
    Lightmaps lightmaps = test::make_full_lightmaps();
    lightmaps.light.pop_back();
    EXPECT_TRUE(make_light_texture(lightmaps.view()).empty());
    lightmaps.light.clear();
    EXPECT_TRUE(make_light_texture(lightmaps.view()).empty());
}

}  // namespace
}  // namespace tetralight
