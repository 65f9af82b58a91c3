// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_volume.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/probe_groups.h"
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

using test::make_group;

BakeSettings few_samples(uint32_t thread_count = 0) {
    BakeSettings settings;
    settings.sample_count = 32;
    settings.thread_count = thread_count;
    return settings;
}

BakeVolumeSettings with(const BakeSettings& settings) {
    BakeVolumeSettings result;
    result.bake = settings;
    return result;
}

BakedVolume bake(const Scene& scene, const std::vector<ProbeGroup>& groups,
                 const BakeSettings& settings = few_samples()) {
    auto baked = bake_volume(scene, groups, with(settings));
    EXPECT_TRUE(baked) << error_text(baked.error());
    return std::move(*baked);
}

std::vector<std::byte> bytes(const BakedVolume& baked) {
    return probe_file_bytes(baked.volume.view());
}

/// A room of the box [-2, 2]³ with a lamp.
Scene room() {
    Scene scene;
    test::add_box(scene, test::diffuse({0.8f, 0.6f, 0.4f}), test::Facing::Inward, {-2, -2, -2},
                  {2, 2, 2});
    test::add_point_light(scene, LightMode::Baked, {3, 2, 1}, {0.5f, 1.5f, 0.5f});
    return scene;
}

std::vector<ProbeGroup> three_groups() {
    return {make_group("hall", test::random_positions(20, 1)),
            make_group("attic", test::random_positions(15, 2)),
            make_group("cellar", test::random_positions(10, 3))};
}

TEST(BakeVolume, SameBytesForAnyNumberOfThreadsAndEveryRun) {
    const auto expected = bytes(bake(room(), three_groups(), few_samples(1)));
    EXPECT_EQ(bytes(bake(room(), three_groups(), few_samples(2))), expected);
    EXPECT_EQ(bytes(bake(room(), three_groups(), few_samples(2))), expected);
}

TEST(BakeVolume, SameBytesForGroupsInAnotherOrder) {
    auto groups = three_groups();
    const auto expected = bytes(bake(room(), groups));
    std::rotate(groups.begin(), groups.begin() + 1, groups.end());
    EXPECT_EQ(bytes(bake(room(), groups)), expected);
    std::swap(groups[0], groups[1]);
    EXPECT_EQ(bytes(bake(room(), groups)), expected);
}

TEST(BakeVolume, AnotherGroupChangesNoOtherProbe) {
    auto groups = three_groups();
    const ProbeVolume before = bake(room(), groups).volume;
    groups.push_back(make_group("annex", test::random_positions(30, 4, 1.9)));
    const ProbeVolume after = bake(room(), groups).volume;
    size_t found = 0;
    for (size_t i = 0; i < before.exact_positions.size(); ++i) {
        const auto place = std::ranges::find(after.exact_positions, before.exact_positions[i]);
        ASSERT_NE(place, after.exact_positions.end());
        const auto j = static_cast<size_t>(place - after.exact_positions.begin());
        found +=
            after.irradiance[j] == before.irradiance[i] && after.validity[j] == before.validity[i];
    }
    EXPECT_EQ(found, 45u);
    EXPECT_EQ(after.positions.size(), 75u);
}

TEST(BakeVolume, VolumeIsWholeAndLitLikeItsProbes) {
    const BakedVolume baked = bake(room(), three_groups());
    const ProbeVolume& volume = baked.volume;
    const Status status = verify(volume.view());
    EXPECT_TRUE(status) << error_text(status.error());
    const auto light = bake_probes(room(), volume.exact_positions, few_samples());
    ASSERT_TRUE(light);
    for (size_t i = 0; i < volume.irradiance.size(); ++i) {
        EXPECT_EQ(volume.irradiance[i], irradiance_from_radiance(light->radiance[i]));
    }
    EXPECT_EQ(volume.validity, light->validity);
    EXPECT_EQ(baked.report.ray_count, light->ray_count);
}

TEST(BakeVolume, OfNoGroupsAnswersWithTheSky) {
    Scene scene = room();
    scene.environment.radiance = {1, 2, 3};
    scene.probe_groups.push_back(make_group("unused", {{0, 0, 0}}));
    const ProbeVolume volume = bake(scene, {}).volume;
    EXPECT_TRUE(volume.positions.empty());
    const auto answer = interpolate(volume.view(), locate(volume.view(), {0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(answer.irradiance, irradiance_from_radiance(constant_radiance({1, 2, 3})));
    EXPECT_EQ(answer.occlusion, glm::vec4(1.0f));
    EXPECT_TRUE(verify(volume.view()));
}

TEST(BakeVolume, KeepsLightsWithTheirNames) {
    Scene scene = room();
    test::add_sun(scene, LightMode::Mixed, glm::vec3(5.0f));
    scene.light_names = {"lamp", "sun"};
    const ProbeVolume volume = bake(scene, three_groups()).volume;
    EXPECT_EQ(volume.lights, scene.lights);
    EXPECT_EQ(volume.light_names, "lamp\nsun\n");
}

TEST(BakeVolume, MetadataTellsHowItWasMade) {
    BakeSettings settings = few_samples();
    settings.bounces = 3;
    settings.seed = 18446744073709551615u;
    const std::string metadata = bake(Scene{}, {}, settings).volume.metadata;
    EXPECT_EQ(metadata.find("{\"generator\":\"tetralight "), 0u) << metadata;
    for (const char* expected :
         {"\"samples\":32,\"bounces\":3,\"seed\":18446744073709551615,",
          "\"min_validity\":0.75,\"virtual_offset\":0.45,\"invalid_probes\":\"leave-out\"}"}) {
        EXPECT_NE(metadata.find(expected), std::string::npos) << metadata;
    }
}

TEST(BakeVolume, MetadataNamesWhatIsNotTheDefault) {
    BakeSettings settings;
    settings.target_error = 0.02;
    settings.max_sample_count = 4096;
    settings.clamp = 2.5f;
    const std::string metadata = bake(Scene{}, {}, settings).volume.metadata;
    const std::string expected =
        "\"invalid_probes\":\"leave-out\",\"target_error\":0.02,\"max_samples\":4096,\"clamp\":2."
        "5}";
    ASSERT_GE(metadata.size(), expected.size());
    EXPECT_EQ(metadata.substr(metadata.size() - expected.size()), expected);
}

TEST(BakeVolume, KeepsTheErrorOfEachProbe) {
    BakeSettings settings = few_samples();
    settings.sample_count = 128;
    const BakedVolume baked = bake(room(), three_groups(), settings);
    const auto light = bake_probes(room(), baked.volume.exact_positions, settings);
    ASSERT_TRUE(light);
    ASSERT_EQ(baked.volume.health.size(), 45u);
    for (size_t i = 0; i < 45; ++i) {
        EXPECT_GT(baked.volume.health[i].standard_error, 0.0f);
        EXPECT_EQ(baked.volume.health[i].standard_error, light->standard_error[i]);
    }
    EXPECT_EQ(baked.report.statistics, bake_statistics(*light, 0.0));
}

TEST(BakeVolume, CountsWeldedProbes) {
    const auto report =
        bake(Scene{}, {make_group("a", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}),
                       make_group("b", {{0, 0, 0}, {1, 0, 0}, {2, 2, 2}})})
            .report;
    EXPECT_EQ(report.welded_count, 2u);
}

TEST(BakeVolume, PassesErrorsOn) {
    const std::vector<ProbeGroup> twice = {make_group("a", {{0, 0, 0}}),
                                           make_group("a", {{1, 0, 0}})};
    const auto baked = bake_volume(Scene{}, twice, {});
    ASSERT_FALSE(baked);
    EXPECT_EQ(error_text(baked.error()), "group \"a\": there are two groups of this name");
    const auto cancelled = bake_volume(room(), three_groups(), with(few_samples()),
                                       [](const BakeProgress&) { return false; });
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace tetralight
