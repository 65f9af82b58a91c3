// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/blend_lightmaps.h>

#include <gtest/gtest.h>

#include <cmath>

#include <tetralight/lightmap/lightmap_file.h>
#include "tests/lightmap/lightmap_fixture.h"

namespace tetralight {
namespace {

class BlendLightmaps : public testing::Test {
  protected:
    BlendLightmaps() { night.info.scale = 4.0f; }

    const Lightmaps day = test::make_full_lightmaps(1);
    Lightmaps night = test::make_full_lightmaps(2);
};

TEST_F(BlendLightmaps, HasTheLightOfItsEnds) {
    const auto first = blend_lightmaps(day.view(), night.view(), 0.0f);
    const auto last = blend_lightmaps(day.view(), night.view(), 1.0f);
    ASSERT_TRUE(first && last);
    EXPECT_EQ(first->irradiance, day.irradiance);
    EXPECT_EQ(first->light, day.light);
    EXPECT_EQ(first->info, day.info);
    EXPECT_EQ(last->irradiance, night.irradiance);
    EXPECT_EQ(last->light, night.light);
    EXPECT_EQ(last->info.scale, night.info.scale);
}

TEST_F(BlendLightmaps, IsTheWeightedSum) {
    const auto blend = blend_lightmaps(day.view(), night.view(), 0.25f);
    ASSERT_TRUE(blend);
    EXPECT_TRUE(verify(blend->view()));
    for (size_t i = 0; i < day.irradiance.size(); ++i) {
        for (size_t c = 0; c < 3; ++c) {
            const float sum = 0.75f * 0.25f * float_from_half(day.irradiance[i].rgb[c]) +
                              0.25f * 4.0f * float_from_half(night.irradiance[i].rgb[c]);
            const float blended = blend->info.scale * float_from_half(blend->irradiance[i].rgb[c]);
            EXPECT_NEAR(blended, sum, 0x1p-11f * sum);
        }
    }
}

TEST_F(BlendLightmaps, HasNoLayersAndNoErrors) {
    const auto blend = blend_lightmaps(day.view(), night.view(), 0.5f);
    ASSERT_TRUE(blend);
    EXPECT_TRUE(blend->layers.empty() && blend->layer_names.empty());
    EXPECT_TRUE(blend->layer_irradiance.empty() && blend->layer_light.empty());
    EXPECT_TRUE(blend->error.empty());
    EXPECT_EQ(blend->rectangles, day.rectangles);
    EXPECT_EQ(blend->instance_names, day.instance_names);
}

TEST_F(BlendLightmaps, RefusesOtherLayouts) {
    using Break = void (*)(Lightmaps&);
    for (const Break break_it : std::initializer_list<Break>{
             [](Lightmaps& l) { l.info.page_size = 8; },
             [](Lightmaps& l) { l.info.page_count = 1; },
             [](Lightmaps& l) { l.rectangles.pop_back(); },
             [](Lightmaps& l) { l.rectangles[1].x = 0; },
             [](Lightmaps& l) { l.meshes[0].geometry_key = 1; },
             [](Lightmaps& l) { l.corner_uvs[0].x = 0.5f; }, [](Lightmaps& l) { l.light.clear(); },
             [](Lightmaps& l) { l.info.mixed_lighting = MixedLighting::Subtractive; }}) {
        Lightmaps other = night;
        break_it(other);
        const auto blend = blend_lightmaps(day.view(), other.view(), 0.5f);
        ASSERT_FALSE(blend);
        EXPECT_EQ(blend.error().code, ErrorCode::InvalidArgument);
    }
}

TEST_F(BlendLightmaps, RefusesFractionsOutOfRange) {
    for (const float t : {-0.1f, 1.1f, std::nanf("")}) {
        const auto blend = blend_lightmaps(day.view(), night.view(), t);
        ASSERT_FALSE(blend);
        EXPECT_EQ(blend.error().field, "t");
    }
}

}  // namespace
}  // namespace tetralight
