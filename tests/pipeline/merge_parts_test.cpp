// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/merge_parts.h>

#include "tests/pipeline/part_fixture.h"

namespace tetralight {
namespace {

class MergeParts : public test::PartFixture {
  protected:
    [[nodiscard]] std::string error_of(const std::vector<std::string>& paths) const {
        const auto merged = merge_parts(paths);
        EXPECT_FALSE(merged);
        return merged ? "" : error_text(merged.error());
    }

    void expect_whole(const std::vector<std::string>& paths) const {
        const auto merged = merge_parts(paths);
        ASSERT_TRUE(merged) << error_text(merged.error());
        EXPECT_EQ(probe_file_bytes(merged->volume.view()), whole());
    }
};

TEST_F(MergeParts, GivesTheBytesOfOneBakeInAnyOrderOfTheParts) {
    const std::string a = bake_part("a", {0, 12}), b = bake_part("b", {12, 13}),
                      c = bake_part("c", {13, kProbeCount});
    expect_whole({a, b, c});
    expect_whole({c, a, b});
    const std::string d = bake_part("d", {12, kProbeCount, 3}),
                      e = bake_part("e", {13, kProbeCount, 3}),
                      f = bake_part("f", {14, kProbeCount, 3});
    expect_whole({f, a, d, e});
}

TEST_F(MergeParts, OfAdaptiveBakesToo) {
    settings.target_error = 0.02;
    settings.max_sample_count = 1024;
    expect_whole({bake_part("a", {0, 12}), bake_part("b", {12, kProbeCount})});
}

TEST_F(MergeParts, ReportsAsOneBakeDoes) {
    const auto merged = merge_parts({bake_part("a", {0, 12}), bake_part("b", {12, kProbeCount})});
    const auto baked = bake_volume(scene, groups, {{}, settings, {}, {}});
    ASSERT_TRUE(merged && baked);
    EXPECT_EQ(merged->report.ray_count, baked->report.ray_count);
    EXPECT_EQ(merged->report.statistics, baked->report.statistics);
    EXPECT_EQ(merged->report.warnings, baked->report.warnings);
    EXPECT_EQ(merged->report.unseen, baked->report.unseen);
    VisibilityReport walls = baked->report.visibility;
    walls.ray_count = 0;  // parts keep neither the rays nor the time
    walls.seconds = 0.0;
    EXPECT_EQ(merged->report.visibility, walls);
}

TEST_F(MergeParts, NamesWhatOverlaps) {
    const std::string a = bake_part("a", {0, 12}), b = bake_part("b", {11, kProbeCount});
    EXPECT_EQ(error_of({a, b}), b + ": probes 11..35 overlap probes 0..12 of " + a);
    EXPECT_EQ(error_of({a, a}), a + ": probes 0..12 overlap probes 0..12 of " + a);
}

TEST_F(MergeParts, NamesWhatIsMissing) {
    const std::string a = bake_part("a", {0, 12}), b = bake_part("b", {20, 30});
    EXPECT_EQ(error_of({a, b}),
              "probes 12..20 and 5 others of 35 are in no part; the next, 20..30, are in " + b);
    EXPECT_EQ(error_of({b}),
              "probes 0..20 and 5 others of 35 are in no part; the next, 20..30, are in " + b);
    EXPECT_EQ(error_of({a}), "probes 12..35 of 35 are in no part; the last, 0..12, are in " + a);
}

TEST_F(MergeParts, RefusesPartsOfOtherScenesGroupsAndSettings) {
    const std::string a = bake_part("a", {0, 12});
    const auto refuse = [&] {
        const std::string b = bake_part("b", {12, kProbeCount});
        EXPECT_EQ(error_of({a, b}), b + ": is of another bake than " + a +
                                        " (scene, groups, settings or program version differ)");
    };
    settings.seed = 1;
    refuse();
    settings.seed = 0;
    scene.lights[0].intensity.y = 2.5f;
    refuse();
    scene.lights[0].intensity.y = 2.0f;
    groups[0].positions[0].x += 0.01;
    refuse();
}

TEST_F(MergeParts, NamesFilesThatAreNoParts) {
    EXPECT_EQ(error_of({path("none")}).find(path("none") + ": cannot open"), 0u);
    const auto baked = bake_volume(scene, groups, {{}, settings, {}, {}});
    ASSERT_TRUE(baked && write_probe_file(path("whole"), baked->volume.view()));
    EXPECT_EQ(error_of({path("whole")}).find(path("whole") + ": is not a part of a bake"), 0u);
}

}  // namespace
}  // namespace tetralight
