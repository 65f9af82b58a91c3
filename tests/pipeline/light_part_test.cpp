// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>
#include <tetralight/pipeline/merge_parts.h>
#include <tetralight/pipeline/reuse_probes.h>

#include "tests/pipeline/part_fixture.h"

namespace tetralight {
namespace {

class LightParts : public test::PartFixture {
  protected:
    /// Writes the prepared bake of the scene and settings as they are.
    [[nodiscard]] std::string plan(const std::string& name = "prepared") const {
        const Status status = write_prepared_bake(path(name), prepare());
        EXPECT_TRUE(status) << error_text(status.error());
        return path(name);
    }

    [[nodiscard]] Result<PreparedBake> read(const std::string& prepared_path) const {
        return read_prepared_bake(prepared_path, scene, {{}, settings, {}, {}, lighting});
    }

    /// Bakes a range as a machine does that has only the scene and the prepared bake.
    [[nodiscard]] std::string bake_light(const std::string& prepared_path, const std::string& name,
                                         PlaceRange range) const {
        const auto prepared = read(prepared_path);
        EXPECT_TRUE(prepared) << error_text(prepared.error());
        const Status status = write_light_part(path(name), *prepared, bake(*prepared, range));
        EXPECT_TRUE(status) << error_text(status.error());
        return path(name);
    }

    void expect_whole(const std::string& prepared_path,
                      const std::vector<std::string>& paths) const {
        const auto merged = merge_light_parts(prepared_path, paths);
        ASSERT_TRUE(merged) << error_text(merged.error());
        EXPECT_EQ(probe_file_bytes(merged->volume.view()), whole());
    }

    [[nodiscard]] static std::string error_of(const std::string& prepared_path,
                                              const std::vector<std::string>& paths) {
        const auto merged = merge_light_parts(prepared_path, paths);
        EXPECT_FALSE(merged);
        return merged ? "" : error_text(merged.error());
    }
};

TEST_F(LightParts, GiveTheBytesOfOneBakeInAnyOrder) {
    const std::string prepared = plan();
    const std::string a = bake_light(prepared, "a", {0, 12}),
                      b = bake_light(prepared, "b", {12, 13}),
                      c = bake_light(prepared, "c", {13, kProbeCount});
    expect_whole(prepared, {a, b, c});
    expect_whole(prepared, {c, a, b});
}

TEST_F(LightParts, OfEveryFewProbesGiveTheBytesOfOneBake) {
    const std::string prepared = plan();
    std::vector<std::string> parts;
    for (const PlaceRange& range : spread_ranges(kProbeCount, 4))
        parts.push_back(bake_light(prepared, name_of(range), range));
    expect_whole(prepared, parts);
}

TEST_F(LightParts, WithLayersOcclusionAndTargetsToo) {
    lighting.mixed_lighting = MixedLighting::Shadowmask;
    lighting.layers = {"sky", "transfer"};
    test::add_point_light(scene, LightMode::Mixed, {1, 1, 1}, {-0.5f, 0.5f, 0.5f});
    settings.target_error = 0.05;
    settings.max_sample_count = 512;
    const std::string prepared = plan();
    expect_whole(prepared, {bake_light(prepared, "a", {0, 20}),
                            bake_light(prepared, "b", {20, kProbeCount})});
}

TEST_F(LightParts, WithReusedLightToo) {
    const auto old = bake_volume(scene, groups, {{}, settings, {}, {}, lighting});
    ASSERT_TRUE(old);
    groups[0].positions[3].x += 0.01;
    const std::string prepared_path = plan();
    std::vector<std::string> parts;
    for (const PlaceRange& range : spread_ranges(kProbeCount, 2)) {
        auto prepared = read(prepared_path);
        ASSERT_TRUE(prepared);
        ASSERT_TRUE(reuse_probes(old->volume.view(), *prepared));
        const PartialBake partial = bake(*prepared, range);
        EXPECT_GE(partial.reused.probes.size() + 1, range.count());
        parts.push_back(path("part" + std::to_string(range.begin)));
        ASSERT_TRUE(write_light_part(parts.back(), *prepared, partial));
    }
    expect_whole(prepared_path, parts);
}

TEST_F(LightParts, AreAsSmallAsTheirLight) {
    const std::string prepared = plan();
    const auto bytes = read_file(bake_light(prepared, "a", {0, 1}));
    ASSERT_TRUE(bytes);
    EXPECT_LT(bytes->size(), 4096u);
}

TEST_F(LightParts, OfOtherBakesAreNamed) {
    const std::string prepared = plan();
    const std::string a = bake_light(prepared, "a", {0, 12});
    settings.seed = 1;
    const std::string b = bake_light(plan("other"), "b", {12, kProbeCount});
    EXPECT_EQ(error_of(prepared, {a, b}),
              b + ": is of another bake than the prepared one (scene, groups, settings or program "
                  "version differ)");
}

TEST_F(LightParts, AreRefusedWhereTheyAreMissingOrTwice) {
    const std::string prepared = plan();
    const std::string a = bake_light(prepared, "a", {0, 12});
    EXPECT_EQ(error_of(prepared, {a}),
              "probes 12..35 of 35 are in no part; the last, 0..12, are in " + a);
    EXPECT_EQ(error_of(prepared, {a, a}), a + ": probes 0..12 overlap probes 0..12 of " + a);
}

TEST_F(LightParts, AndPartsWithCellsAreToldApart) {
    const std::string prepared = plan();
    const std::string light = bake_light(prepared, "a", {0, 12}), part = bake_part("b", {0, 12});
    EXPECT_EQ(error_of(prepared, {part}),
              part + ": is a part with cells of its own; merge such parts without --prepared");
    const auto merged = merge_parts({light});
    ASSERT_FALSE(merged);
    EXPECT_EQ(error_text(merged.error()),
              light +
                  ": is the light of a part without its cells; name the prepared bake too "
                  "(--prepared)");
    EXPECT_EQ(error_of(part, {light}), part + ": is not a prepared bake (plan writes them)");
}

TEST_F(LightParts, DamagedOnesAreNamed) {
    const std::string prepared = plan();
    const std::string a = bake_light(prepared, "a", {0, kProbeCount});
    auto bytes = read_file(a);
    ASSERT_TRUE(bytes);
    bytes->at(bytes->size() / 2) ^= std::byte{1};
    ASSERT_TRUE(write_file(a, *bytes));
    EXPECT_EQ(error_of(prepared, {a}).find(a + ": "), 0u);
}

TEST_F(LightParts, NeedTheSceneAndSettingsThatWerePrepared) {
    const std::string prepared = plan();
    const auto refused = [&](const std::string& what) {
        const auto read_again = read(prepared);
        ASSERT_FALSE(read_again);
        EXPECT_EQ(error_text(read_again.error()),
                  prepared + ": is prepared for " + what + "; plan the bake again");
    };
    settings.seed = 1;
    refused("other settings or program version");
    settings.seed = 0;
    lighting.layers = {"sky"};
    refused("other settings or program version");
    lighting.layers = {};
    scene.lights[0].intensity.y = 2.5f;
    refused("another scene");
}

}  // namespace
}  // namespace tetralight
