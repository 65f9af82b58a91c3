// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lightmap_part.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "tests/pipeline/lightmap_part_fixture.h"

namespace tetralight {
namespace {

class LightmapPart : public test::LightmapPartFixture {
  protected:
    using Change = std::function<void(PreparedLightmaps&, TexelBake&)>;

    /// Writes a part that was changed, and returns why it cannot be read, without the path.
    [[nodiscard]] std::string refusal(const Change& change) const {
        PreparedLightmaps prepared = prepare();
        TexelBake partial = bake(prepared, {3, 9});
        change(prepared, partial);
        EXPECT_TRUE(write_lightmap_part(folder.path("bad"), prepared, partial));
        const auto part = read_lightmap_part(folder.path("bad"));
        EXPECT_FALSE(part);
        const std::string path = folder.path("bad") + ": ";
        const std::string text = part ? path : error_text(part.error());
        EXPECT_TRUE(text.starts_with(path)) << text;
        return text.substr(path.size());
    }
};

TEST_F(LightmapPart, ReadsBackWhatWasWritten) {
    settings.lighting.layers = {"sky"};
    const PreparedLightmaps prepared = prepare();
    const TexelBake partial = bake(prepared, {3, 9});
    ASSERT_TRUE(write_lightmap_part(folder.path("part"), prepared, partial));
    const auto part = read_lightmap_part(folder.path("part"));
    ASSERT_TRUE(part) << error_text(part.error());
    EXPECT_EQ(part->partial.range, partial.range);
    EXPECT_EQ(part->partial.accumulators, partial.accumulators);
    EXPECT_EQ(part->partial.rows, partial.rows);
    EXPECT_EQ(part->partial.normals, partial.normals);
    EXPECT_EQ(part->prepared.key, prepared.key);
    EXPECT_EQ(part->prepared.baked, prepared.baked);
    EXPECT_EQ(part->prepared.lightmaps, prepared.lightmaps);
    EXPECT_EQ(part->prepared.texels.first_texel, prepared.texels.first_texel);
    EXPECT_EQ(part->prepared.report.chart_count, prepared.report.chart_count);
    EXPECT_EQ(part->prepared.report.invalid_count, prepared.report.invalid_count);
    EXPECT_GT(prepared.report.invalid_count, 0u);
}

TEST_F(LightmapPart, IsALightmapFileWithoutPages) {
    const auto file = open_lightmap_file(bake_part("part", {3, 9}));
    ASSERT_TRUE(file) << error_text(file.error());
    EXPECT_TRUE(is_part(*file));
    EXPECT_EQ(file->view().texel_count(), 0u);
    const auto whole_maps = bake_lightmaps(scene, settings);
    ASSERT_TRUE(whole_maps);
    ASSERT_TRUE(write_lightmap_file(folder.path("whole"), whole_maps->lightmaps.view()));
    const auto whole_file = open_lightmap_file(folder.path("whole"));
    ASSERT_TRUE(whole_file);
    EXPECT_FALSE(is_part(*whole_file));
}

TEST_F(LightmapPart, RefusesTalliesThatNoRoundsLeave) {
    const std::string where = "section \"tallies\": element of texel 4 is out of range";
    EXPECT_EQ(refusal([](auto&, auto& b) { b.accumulators[1].radiance_sum[3].z = NAN; }), where);
    EXPECT_EQ(refusal([](auto&, auto& b) { b.accumulators[1].sample_count = 127; }), where);
    EXPECT_EQ(refusal([](auto&, auto& b) { b.accumulators[1] = {}; }), where);
    EXPECT_EQ(refusal([](auto&, auto& b) { b.rows.resize(5); }),
              "section \"split_rows\": 5 numbers for 6 texels of 0");
    EXPECT_EQ(refusal([](auto&, auto& b) { b.normals[2].y = INFINITY; }),
              "section \"texel_normals\": element 2: is not finite");
    EXPECT_EQ(refusal([](auto&, auto& b) { b.normals.pop_back(); }),
              "section \"texel_normals\": 5 elements for 6 texels");
    EXPECT_EQ(refusal([](auto&, auto& b) { b.mapped_normals.resize(23); }),
              "section \"mapped_normals\": 23 elements for 6 texels");
    EXPECT_EQ(refusal([](auto&, auto& b) { b.mapped_normals.resize(24, glm::vec3(NAN)); }),
              "section \"mapped_normals\": element 0: is not finite");
}

TEST_F(LightmapPart, RefusesRangesThatAreNone) {
    const std::string count = std::to_string(texel_count());
    EXPECT_EQ(refusal([](auto& p, auto& b) {
                  const auto all = static_cast<uint32_t>(p.baked.size());
                  b.range = {all - 5, all + 1};
              }),
              "texels " + std::to_string(texel_count() - 5) + ".." +
                  std::to_string(texel_count() + 1) + " are out of range (there are " + count +
                  ")");
}

TEST_F(LightmapPart, RefusesPlacesOutsideOfThePages) {
    EXPECT_EQ(refusal([](auto& p, auto&) { p.lightmaps.rectangles[1].page = 3; }),
              "section \"part_rectangles\": element 1: page 3 is out of range");
    EXPECT_NE(refusal([](auto& p, auto&) { p.lightmaps.rectangles[1].x = 31; }), "");
    EXPECT_EQ(refusal([](auto& p, auto&) { p.seams[0].second.end.x = 33.0f; }),
              "section \"seams\": element 0: is outside of the pages");
    EXPECT_EQ(refusal([](auto& p, auto&) { p.maps[0].texels.back().index = 1u << 20; }),
              "section \"covered_texels\": texel 1048576 of packing 0 is out of range");
    EXPECT_EQ(refusal([](auto& p, auto&) { p.maps[0].width = 33; }),
              "section \"packings\": element 0: is out of range");
    EXPECT_EQ(refusal([](auto& p, auto&) { p.maps[0].charts.push_back(0); }),
              "section \"footprints\": has more elements than its packings");
}

TEST_F(LightmapPart, RefusesAFileCutOrChangedAnywhere) {
    std::ifstream stream(bake_part("sound", {3, 9}), std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    ASSERT_GT(bytes.size(), 4096u);
    for (size_t i = 0; i < bytes.size(); i += 61) {
        EXPECT_FALSE(read_lightmap_part(folder.write("cut", bytes.substr(0, i)))) << i;
        std::string changed = bytes;
        changed[i] = static_cast<char>(~changed[i]);
        EXPECT_FALSE(read_lightmap_part(folder.write("changed", changed))) << i;
    }
}

}  // namespace
}  // namespace tetralight
