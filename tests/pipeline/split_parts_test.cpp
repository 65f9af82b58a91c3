// SPDX-License-Identifier: Apache-2.0
// Bakes with layers, transfer and occlusion give the same bytes for ranges, threads and resume.
#include <fstream>

#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/merge_parts.h>
#include "tests/pipeline/part_fixture.h"

namespace tetralight {
namespace {

class SplitParts : public test::PartFixture {
  protected:
    SplitParts() {
        Light& lamp = test::add_point_light(scene, LightMode::Mixed, {3, 2, 1}, {1, 1, 1});
        lamp.radius = 0.1f;
        scene.light_names = {"bulb", "lamp"};
        scene.materials[0].emission = {1, 2, 3};
        lighting.mixed_lighting = MixedLighting::Shadowmask;
        lighting.layers = {"light:lamp", "emission", "transfer"};
        groups[0].dering = true;
        settings.target_error = 0.02;
        settings.max_sample_count = 512;
    }
};

TEST_F(SplitParts, GiveTheBytesOfOneBakeInAnyOrderAndOnAnyThreads) {
    settings.thread_count = 1;
    const std::vector<std::byte> expected = whole();
    settings.thread_count = 2;
    EXPECT_EQ(whole(), expected);
    const std::string a = bake_part("a", {0, 12}), b = bake_part("b", {12, kProbeCount});
    const auto merged = merge_parts({b, a});
    ASSERT_TRUE(merged) << error_text(merged.error());
    EXPECT_EQ(probe_file_bytes(merged->volume.view()), expected);
}

TEST_F(SplitParts, ReadBackWhatWasWritten) {
    const PreparedBake prepared = prepare();
    const PartialBake partial = bake(prepared, {3, 9});
    ASSERT_TRUE(write_part(path("part"), prepared, partial));
    const auto part = read_part(path("part"));
    ASSERT_TRUE(part) << error_text(part.error());
    EXPECT_EQ(part->partial, partial);
    EXPECT_EQ(part->prepared.volume.layers, prepared.volume.layers);
    EXPECT_EQ(part->prepared.volume.layer_names, prepared.volume.layer_names);
    EXPECT_EQ(part->prepared.volume.occlusion_lights, prepared.volume.occlusion_lights);
}

TEST_F(SplitParts, RefuseRowsThatAreMissingOrNotFinite) {
    const PreparedBake prepared = prepare();
    PartialBake partial = bake(prepared, {3, 9});
    const auto error_of = [&] {
        EXPECT_TRUE(write_part(path("part"), prepared, partial));
        const auto part = read_part(path("part"));
        EXPECT_FALSE(part);
        return part ? "" : error_text(part.error());
    };
    partial.split_rows[partial.split_rows.size() / 6 + 3] = std::numeric_limits<double>::infinity();
    EXPECT_EQ(error_of(), path("part") + ": section \"split_rows\": row of probe 4 is not finite");
    partial.split_rows.pop_back();
    EXPECT_EQ(error_of().find(path("part") + ": section \"split_rows\": "), 0u);
}

TEST_F(SplitParts, KeyChangesWithLayersAndMode) {
    const uint64_t key = prepare().key;
    lighting.layers.pop_back();
    EXPECT_NE(prepare().key, key);
    lighting.layers.push_back("transfer");
    EXPECT_EQ(prepare().key, key);
    lighting.mixed_lighting = MixedLighting::Subtractive;
    EXPECT_NE(prepare().key, key);
}

}  // namespace
}  // namespace tetralight
