// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/mixed_lighting.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

TEST(MixedLighting, TakesWhatTheTableSays) {
    for (const MixedLighting mode :
         {MixedLighting::Indirect, MixedLighting::Shadowmask, MixedLighting::Subtractive}) {
        EXPECT_EQ(baked_terms(LightMode::Realtime, mode), (BakedTerms{false, false, false}));
        EXPECT_EQ(baked_terms(LightMode::Baked, mode), (BakedTerms{true, true, false}));
        EXPECT_EQ(baked_terms(LightMode::Mixed, mode),
                  (BakedTerms{false, true, mode != MixedLighting::Indirect}));
    }
}

TEST(MixedLighting, AreaLightsHaveNoOcclusion) {
    EXPECT_TRUE(can_have_occlusion(LightType::Directional));
    EXPECT_TRUE(can_have_occlusion(LightType::Point));
    EXPECT_TRUE(can_have_occlusion(LightType::Spot));
    EXPECT_FALSE(can_have_occlusion(LightType::Rectangle));
    EXPECT_FALSE(can_have_occlusion(LightType::Disc));
}

TEST(MixedLighting, HasAWordForEachMode) {
    EXPECT_STREQ(name_of(MixedLighting::Indirect), "indirect");
    EXPECT_STREQ(name_of(MixedLighting::Shadowmask), "shadowmask");
    EXPECT_STREQ(name_of(MixedLighting::Subtractive), "subtractive");
}

}  // namespace
}  // namespace tetralight
