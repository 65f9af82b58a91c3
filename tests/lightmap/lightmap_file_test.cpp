// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/lightmap_file.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>
#include <tetralight/lightmap/lightmap_members.h>
#include <tetralight/lightmap/sample_lightmap.h>
#include "tests/lightmap/lightmap_fixture.h"

namespace tetralight {
namespace {

namespace fs = std::filesystem;

class LightmapFileTest : public testing::Test {
  protected:
    ~LightmapFileTest() override { fs::remove(path); }

    /// Without the syncing that write_file does: these tests write thousands of files.
    void write(std::span<const std::byte> bytes) const {
        std::ofstream stream(path, std::ios::binary | std::ios::trunc);
        stream.write(reinterpret_cast<const char*>(bytes.data()),
                     static_cast<std::streamsize>(bytes.size()));
    }

    const std::string path =
        (fs::temp_directory_path() / ("tetralight_lightmap_file_" + std::to_string(getpid())))
            .string();
    const Lightmaps lightmaps = test::make_full_lightmaps();
};

detail::FileHeader header_of(std::span<const std::byte> bytes) {
    detail::FileHeader header;
    std::memcpy(&header, bytes.data(), sizeof header);
    return header;
}

std::span<detail::SectionEntry> table_of(std::span<std::byte> bytes) {
    return {reinterpret_cast<detail::SectionEntry*>(bytes.data() + sizeof(detail::FileHeader)),
            header_of(bytes).section_count};
}

/// Reads every place that samples read.
void sample_everywhere(const LightmapsView& view) {
    for (const LightmapRectangle& rectangle : view.rectangles) {
        for (const float u : {-1.0f, 0.0f, 0.4f, 1.0f, std::nanf("")}) {
            const glm::vec2 uv = page_uv(rectangle, {u, 1.0f - u});
            const glm::vec3 e = sample_irradiance(view, rectangle.page, uv);
            ASSERT_TRUE(std::isfinite(e.x + e.y + e.z));
            static_cast<void>(sample_lightmap(view, rectangle.page, uv, {{0, 1, 0}, {0, 1, 0}}));
        }
    }
}

TEST_F(LightmapFileTest, ReadsBackEverySection) {
    ASSERT_TRUE(write_lightmap_file(path, lightmaps.view()));
    const auto file = open_lightmap_file(path);
    ASSERT_TRUE(file) << error_text(file.error());
    EXPECT_EQ(copy_lightmaps(file->view()), lightmaps);
}

TEST_F(LightmapFileTest, OpensBytesThatGoAfterwards) {
    std::vector<std::byte> bytes = lightmap_file_bytes(lightmaps.view());
    auto opened = open_lightmap_memory(bytes);
    ASSERT_TRUE(opened) << error_text(opened.error());
    bytes.assign(bytes.size(), std::byte{0xff});
    const LightmapFile file = std::move(*opened);
    EXPECT_EQ(copy_lightmaps(file.view()), lightmaps);
    const auto refused = open_lightmap_memory(bytes);
    ASSERT_FALSE(refused);
    EXPECT_EQ(error_text(refused.error()), "memory: not a lightmap file (wrong first bytes)");
}

TEST_F(LightmapFileTest, RefusesBytesInMemoryThatAreWrong) {
    std::vector<std::byte> bytes = lightmap_file_bytes(lightmaps.view());
    bytes[table_of(bytes).back().offset] ^= std::byte{1};
    const auto file = open_lightmap_memory(bytes);
    ASSERT_FALSE(file);
    EXPECT_EQ(error_text(file.error()), "memory: section \"metadata\" is corrupt (wrong checksum)");
}

TEST_F(LightmapFileTest, SamplesTheMappedBytesAsMemory) {
    ASSERT_TRUE(write_lightmap_file(path, lightmaps.view()));
    auto opened = open_lightmap_file_lazy(path);
    ASSERT_TRUE(opened);
    const LightmapFile file = std::move(*opened);  // the view must survive a move
    for (const float u : {0.1f, 0.5f, 0.8f}) {
        EXPECT_EQ(sample_irradiance(file.view(), 1, {u, 0.3f}),
                  sample_irradiance(lightmaps.view(), 1, {u, 0.3f}));
    }
}

TEST_F(LightmapFileTest, HasItsMagicAndAlignedSectionsInTheOrderOfTheMembers) {
    std::vector<std::byte> bytes = lightmap_file_bytes(lightmaps.view());
    EXPECT_EQ(std::memcmp(bytes.data(), "TETRALM\n", 8), 0);
    EXPECT_EQ(header_of(bytes).version, 1u);
    EXPECT_EQ(bytes.size() % 64, 0u);
    std::vector<std::string> names{"info"}, found;
    for_each_lightmap_member([&](const char* name, auto, auto) { names.emplace_back(name); });
    for (const detail::SectionEntry& entry : table_of(bytes)) {
        EXPECT_EQ(entry.offset % 64, 0u);
        found.push_back(detail::section_name(entry));
    }
    EXPECT_EQ(found, names);
}

TEST(LightmapFile, IsToldByItsFirstBytes) {
    const auto bytes_of = [](std::string_view text) { return std::as_bytes(std::span(text)); };
    EXPECT_TRUE(is_lightmap_file(bytes_of("TETRALM\n")));
    EXPECT_TRUE(is_lightmap_file(bytes_of("TETRALM\nand more")));
    EXPECT_FALSE(is_lightmap_file(bytes_of("TETRALM")));
    EXPECT_FALSE(is_lightmap_file(bytes_of("TETRALI\n")));
    EXPECT_FALSE(is_lightmap_file({}));
}

/// Another implementation of the format may rely on these bytes.
TEST_F(LightmapFileTest, OfOneTexelHasTheBytesOfVersion1) {
    Lightmaps one = test::make_black_page(1);
    one.irradiance[0] = test::texel_of({1.0f, 2.0f, 0.5f});
    const std::vector<std::byte> bytes = lightmap_file_bytes(one.view());
    ASSERT_EQ(bytes.size(), 64u + 2 * 64 + 64 + 64);  // header, table, info, irradiance
    const uint32_t info[]{1, 1, 0, 0x3f800000};
    EXPECT_EQ(std::memcmp(bytes.data() + 192, info, sizeof info), 0);
    const uint16_t texel[]{0x3c00, 0x4000, 0x3800, 0x3c00};
    EXPECT_EQ(std::memcmp(bytes.data() + 256, texel, sizeof texel), 0);
}

TEST_F(LightmapFileTest, NoLightmapsAreAFileToo) {
    ASSERT_TRUE(write_lightmap_file(path, LightmapsView{}));
    const auto file = open_lightmap_file(path);
    ASSERT_TRUE(file) << error_text(file.error());
    EXPECT_EQ(sample_irradiance(file->view(), 0, {0.5f, 0.5f}), glm::vec3(0.0f));
}

TEST_F(LightmapFileTest, KeepsSectionsBesideTheLightmaps) {
    const std::vector<uint32_t> numbers{1, 2, 3};
    const ExtraSection extra[] = {{"numbers", std::as_bytes(std::span(numbers)), 4}, {"none", {}}};
    ASSERT_TRUE(write_lightmap_file(path, lightmaps.view(), extra));
    const auto file = open_lightmap_file(path);
    ASSERT_TRUE(file) << error_text(file.error());
    const auto bytes = file->section_bytes("numbers", 4);
    ASSERT_TRUE(bytes && bytes->size() == 12);
    EXPECT_EQ(std::memcmp(bytes->data(), numbers.data(), 12), 0);
    EXPECT_FALSE(file->section_bytes("none", 1));
    EXPECT_EQ(file->sections().back().name, "numbers");
}

TEST_F(LightmapFileTest, RefusesAFileCutAtAnyLength) {
    const std::vector<std::byte> bytes = lightmap_file_bytes(test::make_one_texel().view());
    for (size_t length = 0; length < bytes.size(); ++length) {
        write(std::span(bytes).first(length));
        ASSERT_FALSE(open_lightmap_file(path)) << length;
        ASSERT_FALSE(open_lightmap_file_lazy(path)) << length;
    }
}

TEST_F(LightmapFileTest, RefusesAFileWithAnyByteChanged) {
    std::vector<std::byte> bytes = lightmap_file_bytes(test::make_one_texel().view());
    for (size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] ^= std::byte{0x81};
        write(bytes);
        ASSERT_FALSE(open_lightmap_file(path)) << "byte " << i;
        bytes[i] ^= std::byte{0x81};
    }
}

TEST_F(LightmapFileTest, LazilyOpenedCorruptSectionsNeverReadOutOfRange) {
    std::vector<std::byte> bytes = lightmap_file_bytes(test::make_one_texel().view());
    for (size_t i = table_of(bytes).front().offset; i < bytes.size(); ++i) {
        bytes[i] ^= std::byte{0xff};
        write(bytes);
        bytes[i] ^= std::byte{0xff};
        const auto file = open_lightmap_file_lazy(path);
        ASSERT_TRUE(file);
        sample_everywhere(file->view());
        EXPECT_FALSE(verify(*file)) << "byte " << i;
    }
}

TEST_F(LightmapFileTest, SkipsSectionsItDoesNotKnow) {
    std::vector<std::byte> bytes = lightmap_file_bytes(lightmaps.view());
    table_of(bytes).back().name = {'f', 'u', 't', 'u', 'r', 'e'};
    detail::FileHeader header = header_of(bytes);
    header.checksum = detail::header_checksum(header, table_of(bytes));
    std::memcpy(bytes.data(), &header, sizeof header);
    write(bytes);
    const auto file = open_lightmap_file(path);
    ASSERT_TRUE(file) << error_text(file.error());
    EXPECT_TRUE(file->view().metadata.empty());
}

TEST_F(LightmapFileTest, RefusesFilesOfOtherKindsAndVersions) {
    std::vector<std::byte> bytes = lightmap_file_bytes(lightmaps.view());
    bytes[8] = std::byte{2};
    write(bytes);
    const auto newer = open_lightmap_file(path);
    ASSERT_FALSE(newer);
    EXPECT_EQ(newer.error().code, ErrorCode::Unsupported);
    std::memcpy(bytes.data(), "TETRAPV\n", 8);
    write(bytes);
    const auto probes = open_lightmap_file(path);
    ASSERT_FALSE(probes);
    EXPECT_EQ(error_text(probes.error()), path + ": not a lightmap file (wrong first bytes)");
}

TEST_F(LightmapFileTest, NamesThePathAndTheSection) {
    std::vector<std::byte> bytes = lightmap_file_bytes(lightmaps.view());
    bytes[table_of(bytes).back().offset] ^= std::byte{1};
    write(bytes);
    const auto file = open_lightmap_file(path);
    ASSERT_FALSE(file);
    EXPECT_EQ(error_text(file.error()),
              path + ": section \"metadata\" is corrupt (wrong checksum)");
    EXPECT_EQ(file.error().field, "metadata");
}

TEST_F(LightmapFileTest, LightmapsThatCannotBeReadReplaceNothing) {
    ASSERT_TRUE(write_lightmap_file(path, lightmaps.view()));
    Lightmaps broken = lightmaps;
    broken.info.scale = 3.0f;
    const Status status = write_lightmap_file(path, broken.view());
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::Corrupt);
    EXPECT_EQ(status.error().field, "info.scale");
    EXPECT_TRUE(open_lightmap_file(path));
}

}  // namespace
}  // namespace tetralight
