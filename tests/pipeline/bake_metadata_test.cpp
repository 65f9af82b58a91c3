// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_metadata.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

TEST(BakeMetadata, RecordsTheSettingsThatLightDependsOn) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = 77;
    settings.bake.bounces = 9;
    settings.bake.seed = 18446744073709551615u;
    settings.bake.clamp = 2.5f;
    settings.bake.target_error = 0.02;
    settings.bake.surfaces.albedo_boost = 1.25f;
    settings.bake.surfaces.max_albedo = 0.9f;
    settings.health.min_validity = 0.6f;
    settings.health.invalid = InvalidProbes::Keep;
    settings.lighting.mixed_lighting = MixedLighting::Subtractive;
    const auto recorded = recorded_settings(bake_metadata({}, settings, false, false));
    ASSERT_TRUE(recorded);
    EXPECT_EQ(*recorded, settings);
}

TEST(BakeMetadata, OfVolumesThatRecordNothingMeansTheDefaults) {
    EXPECT_EQ(*recorded_settings(""), BakeVolumeSettings{});
    EXPECT_EQ(*recorded_settings(R"({"generator":"another"})"), BakeVolumeSettings{});
}

TEST(BakeMetadata, WithAMemberOfAnotherTypeIsCorrupt) {
    for (const char* metadata : {R"({"bounces":"4"})", R"({"bounces":-1})", R"({"bounces":1e30})",
                                 R"({"bounces":4294967296})"}) {
        const auto recorded = recorded_settings(metadata);
        ASSERT_FALSE(recorded) << metadata;
        EXPECT_EQ(recorded.error().code, ErrorCode::Corrupt);
        EXPECT_EQ(recorded.error().field, "bounces");
    }
    EXPECT_EQ(recorded_settings(R"({"mixed_lighting":"all"})").error().field, "mixed_lighting");
    EXPECT_EQ(recorded_settings("[1]").error().field, "metadata");
}

TEST(BakeMetadata, TellsAnotherSceneAndAnotherLight) {
    Scene scene;
    const std::string metadata = bake_metadata(scene, {}, false, false);
    EXPECT_FALSE(is_of_another_scene(metadata, scene));
    scene.environment.radiance.x = 1.0f;
    EXPECT_TRUE(is_of_another_scene(metadata, scene));
    EXPECT_FALSE(is_of_another_scene("{}", scene));
    EXPECT_FALSE(was_relit(metadata));
    EXPECT_TRUE(was_relit(R"({"relit":"--sky 2"})"));
}

}  // namespace
}  // namespace tetralight
