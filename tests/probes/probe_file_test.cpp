// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/probe_file.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>
#include <tetralight/probes/detail/probe_file_layout.h>
#include <tetralight/probes/interpolate.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

namespace fs = std::filesystem;

ProbeVolume make_full_volume() {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(12, 1));
    volume.occlusion.assign(volume.positions.size(), glm::vec4(0.25f));
    volume.validity.assign(volume.positions.size(), 0.75f);
    volume.health.assign(volume.positions.size(), {0.01f, 2.0f, {0.1f, 0, 0}, 1});
    volume.rendering_layers.assign(volume.positions.size(), 0b1001);
    volume.info.ambient = test::linear_light({1, 2, 3});
    volume.lights.resize(2);
    volume.light_names = "sun\nlamp\n";
    volume.metadata = "{\"samples\":16}";
    volume.light_states.resize(2);
    volume.occlusion_lights.assign(volume.positions.size(), {1, kNoIndex, kNoIndex, kNoIndex});
    volume.layers.resize(2);
    volume.layer_names = "sky\nrest\n";
    volume.layer_irradiance.assign(2 * volume.positions.size(), test::linear_light({0, 0, 1}));
    for (Layer& layer : volume.layers) layer.largest = largest_coefficient(volume.layer_irradiance);
    volume.sky.resize(1);
    return volume;
}

class ProbeFileTest : public testing::Test {
  protected:
    ~ProbeFileTest() override { fs::remove(path); }

    /// Without the syncing that write_file does: these tests write some ten thousand files.
    void write(std::span<const std::byte> bytes) const {
        std::ofstream stream(path, std::ios::binary | std::ios::trunc);
        stream.write(reinterpret_cast<const char*>(bytes.data()),
                     static_cast<std::streamsize>(bytes.size()));
    }

    const std::string path =
        (fs::temp_directory_path() / ("tetralight_probe_file_" + std::to_string(getpid())))
            .string();
    const ProbeVolume volume = make_full_volume();
};

TEST_F(ProbeFileTest, ReadsBackEverySection) {
    ASSERT_TRUE(write_probe_file(path, volume.view()));
    const auto file = open_probe_file(path);
    ASSERT_TRUE(file) << error_text(file.error());
    EXPECT_EQ(probe_file_bytes(file->view()), probe_file_bytes(volume.view()));
    EXPECT_EQ(file->view().info, volume.info);
    EXPECT_EQ(file->view().light_names, volume.light_names);
    EXPECT_EQ(file->view().irradiance[3], volume.irradiance[3]);
}

TEST_F(ProbeFileTest, AnswersFromTheMappedBytesAsFromMemory) {
    ASSERT_TRUE(write_probe_file(path, volume.view()));
    auto opened = open_probe_file_lazy(path);
    ASSERT_TRUE(opened);
    const ProbeFile file = std::move(*opened);  // the view must survive a move
    for (const glm::dvec3& p : test::random_positions(100, 2, 2.0)) {
        const CellLocation location = locate(file.view(), glm::vec3(p));
        EXPECT_EQ(location, locate(volume.view(), glm::vec3(p)));
        EXPECT_EQ(interpolate(file.view(), location), interpolate(volume.view(), location));
    }
}

TEST_F(ProbeFileTest, OpensBytesThatGoAfterwards) {
    const std::vector<std::byte> bytes = probe_file_bytes(volume.view());
    std::vector<std::byte> shifted(bytes.size() + 1);
    const auto odd = std::span(shifted).subspan(1);  // on no boundary
    std::ranges::copy(bytes, odd.begin());
    auto opened = open_probe_memory(odd);
    ASSERT_TRUE(opened) << error_text(opened.error());
    std::ranges::fill(shifted, std::byte{0xff});
    const ProbeFile file = std::move(*opened);
    EXPECT_EQ(copy_volume(file.view()), volume);
    EXPECT_TRUE(verify(file));
    file.release_pages();
    EXPECT_TRUE(verify(file));
}

TEST_F(ProbeFileTest, RefusesBytesInMemoryCutAtAnyLength) {
    const std::vector<std::byte> bytes = probe_file_bytes(volume.view());
    for (size_t length = 0; length < bytes.size(); ++length) {
        const std::vector<std::byte> cut(bytes.begin(),
                                         bytes.begin() + static_cast<ptrdiff_t>(length));
        const auto file = open_probe_memory(cut);
        ASSERT_FALSE(file) << length;
        EXPECT_EQ(file.error().code, ErrorCode::Corrupt);
        EXPECT_TRUE(error_text(file.error()).starts_with("memory: "));
    }
}

TEST_F(ProbeFileTest, NamesMemoryAndTheSection) {
    std::vector<std::byte> bytes = probe_file_bytes(volume.view());
    bytes[detail::kAlignment * 60] ^= std::byte{1};
    const auto file = open_probe_memory(bytes);
    ASSERT_FALSE(file);
    EXPECT_FALSE(file.error().field.empty());
    EXPECT_EQ(error_text(file.error()),
              "memory: section \"" + file.error().field + "\" is corrupt (wrong checksum)");
}

TEST_F(ProbeFileTest, HasAlignedSectionsAndAHeaderOf64Bytes) {
    const std::vector<std::byte> bytes = probe_file_bytes(volume.view());
    const auto table = detail::read_section_table(bytes);
    ASSERT_TRUE(table);
    EXPECT_EQ(bytes.size() % 64, 0u);
    EXPECT_EQ(std::memcmp(bytes.data(), "TETRAPV\n", 8), 0);
    for (const auto& entry : *table) EXPECT_EQ(entry.offset % 64, 0u);
}

TEST_F(ProbeFileTest, KeepsSectionsBesideTheVolume) {
    const std::vector<uint32_t> numbers{1, 2, 3};
    const ExtraSection extra[] = {{"numbers", std::as_bytes(std::span(numbers)), 4}, {"none", {}}};
    ASSERT_TRUE(write_probe_file(path, volume.view(), extra));
    const auto file = open_probe_file(path);
    ASSERT_TRUE(file) << error_text(file.error());
    EXPECT_EQ(probe_file_bytes(file->view()), probe_file_bytes(volume.view()));
    const auto bytes = file->section_bytes("numbers", 4);
    ASSERT_TRUE(bytes && bytes->size() == 12);
    EXPECT_EQ(std::memcmp(bytes->data(), numbers.data(), 12), 0);
    EXPECT_FALSE(file->section_bytes("numbers", 12));
    EXPECT_FALSE(file->section_bytes("none", 1));
}

TEST_F(ProbeFileTest, AnEmptyVolumeIsAFileToo) {
    ASSERT_TRUE(write_probe_file(path, ProbeVolume{}.view()));
    const auto file = open_probe_file(path);
    ASSERT_TRUE(file) << error_text(file.error());
    EXPECT_EQ(file->view().probe_count(), 0u);
}

TEST_F(ProbeFileTest, RefusesAFileCutAtAnyLength) {
    const std::vector<std::byte> bytes = probe_file_bytes(volume.view());
    for (size_t length = 0; length < bytes.size(); ++length) {
        write(std::span(bytes).first(length));
        ASSERT_FALSE(open_probe_file(path)) << length;
        ASSERT_FALSE(open_probe_file_lazy(path)) << length;
    }
}

TEST_F(ProbeFileTest, RefusesAFileWithAnyByteChanged) {
    std::vector<std::byte> bytes = probe_file_bytes(volume.view());
    for (size_t i = 0; i < bytes.size(); ++i) {
        for (const std::byte flip : {std::byte{1}, std::byte{0x80}, std::byte{0xff}}) {
            bytes[i] ^= flip;
            write(bytes);
            ASSERT_FALSE(open_probe_file(path)) << "byte " << i;
            bytes[i] ^= flip;
        }
    }
}

TEST_F(ProbeFileTest, LazilyOpenedCorruptSectionsNeverReadOutOfRange) {
    const std::vector<std::byte> sound = probe_file_bytes(volume.view());
    const size_t first_section = detail::read_section_table(sound)->front().offset;
    for (size_t i = first_section; i < sound.size(); ++i) {
        std::vector<std::byte> bytes = sound;
        bytes[i] ^= std::byte{0xff};
        write(bytes);
        const auto file = open_probe_file_lazy(path);
        ASSERT_TRUE(file);
        for (const glm::vec3& p : {glm::vec3(0.1f), glm::vec3(5.0f, 1.0f, 0.0f)}) {
            const CellLocation location = locate(file->view(), p);
            static_cast<void>(interpolate(file->view(), location));
        }
        EXPECT_FALSE(verify(*file)) << "byte " << i;
    }
}

TEST_F(ProbeFileTest, SkipsSectionsItDoesNotKnow) {
    std::vector<std::byte> bytes = probe_file_bytes(volume.view());
    auto* header = reinterpret_cast<detail::FileHeader*>(bytes.data());
    auto* entries = reinterpret_cast<detail::SectionEntry*>(bytes.data() + sizeof *header);
    entries[header->section_count - 1].name = {'f', 'u', 't', 'u', 'r', 'e'};
    header->checksum = detail::header_checksum(*header, {entries, header->section_count});
    write(bytes);
    const auto file = open_probe_file(path);
    ASSERT_TRUE(file) << error_text(file.error());
    EXPECT_TRUE(file->view().sky.empty());
}

TEST_F(ProbeFileTest, NamesThePathAndTheSection) {
    std::vector<std::byte> bytes = probe_file_bytes(volume.view());
    bytes[detail::read_section_table(bytes)->back().offset] ^= std::byte{1};
    write(bytes);
    const auto file = open_probe_file(path);
    ASSERT_FALSE(file);
    EXPECT_EQ(error_text(file.error()), path + ": section \"sky\" is corrupt (wrong checksum)");
    EXPECT_EQ(file.error().field, "sky");
}

TEST_F(ProbeFileTest, ShowsAnyNameOfASectionInOneLine) {
    std::vector<std::byte> bytes = probe_file_bytes(volume.view());
    auto* header = reinterpret_cast<detail::FileHeader*>(bytes.data());
    auto* entries = reinterpret_cast<detail::SectionEntry*>(bytes.data() + sizeof *header);
    entries[0].name = {'a', '\n', '\x1b', '\xff'};
    entries[0].offset += 1;
    header->checksum = detail::header_checksum(*header, {entries, header->section_count});
    write(bytes);
    const auto file = open_probe_file(path);
    ASSERT_FALSE(file);
    EXPECT_NE(error_text(file.error()).find(R"(a\x0a\x1b\xff)"), std::string::npos)
        << error_text(file.error());
    EXPECT_EQ(file.error().field, R"(a\x0a\x1b\xff)");
}

TEST_F(ProbeFileTest, VerifyRefusesStructureThatChecksumsCannotSee) {
    using Break = void (*)(ProbeVolume&);
    for (const Break break_it : std::initializer_list<Break>{
             [](ProbeVolume& v) { v.cells[0].vertices[1] = 12; },
             [](ProbeVolume& v) { v.cells[0].neighbors[2] = 100000; },
             [](ProbeVolume& v) { v.cells[0].neighbors[0] = v.cells[0].neighbors[1]; },
             [](ProbeVolume& v) { v.cells.back().vertices[3] = 0; },
             [](ProbeVolume& v) { v.hull_rays.pop_back(); },
             [](ProbeVolume& v) { v.hull_rays[0].rays[0] *= 2.0f; },
             [](ProbeVolume& v) { v.positions[0].x = std::nanf(""); },
             [](ProbeVolume& v) { v.irradiance[0].coefficients[8].z = INFINITY; },
             [](ProbeVolume& v) { v.irradiance.pop_back(); },
             [](ProbeVolume& v) { v.occlusion[0].x = 1.5f; },
             [](ProbeVolume& v) { v.validity[0] = -0.1f; },
             [](ProbeVolume& v) { v.health[0].standard_error = -0.1f; },
             [](ProbeVolume& v) { v.rendering_layers.pop_back(); },
             [](ProbeVolume& v) { v.rendering_layers[3] = 0; },
             [](ProbeVolume& v) { v.sources[0].probe = 99; },
             [](ProbeVolume& v) { v.sources[0].group = 1; },
             [](ProbeVolume& v) { v.group_names = "no end"; },
             [](ProbeVolume& v) { v.light_names = "one\n"; },
             [](ProbeVolume& v) { v.light_names = "one\n\xff\n"; },
             [](ProbeVolume& v) { v.metadata = "{\"a\":\"\xff\"}"; },
             [](ProbeVolume& v) { v.metadata = "{\"a\":\"\x1b\"}"; },
             [](ProbeVolume& v) { v.lights[0].type = static_cast<LightType>(9); },
             [](ProbeVolume& v) { v.lights[0].mode = static_cast<LightMode>(3); },
             [](ProbeVolume& v) { v.lights[0].falloff = static_cast<LightFalloff>(4); },
             [](ProbeVolume& v) { v.lights[1].range = std::nanf(""); },
             [](ProbeVolume& v) { v.lights[1].tangent.y = INFINITY; },
             [](ProbeVolume& v) { v.info.inner_cell_count = 100000; }}) {
        ProbeVolume broken = volume;
        break_it(broken);
        EXPECT_FALSE(verify(broken.view()));
    }
    EXPECT_TRUE(verify(volume.view()));
}

/// The links of cell `from` to its neighbors that come before it in the order of cells.
std::vector<uint32_t*> links_to_earlier_cells(ProbeVolume& volume, uint32_t from) {
    std::vector<uint32_t*> links;
    for (uint32_t& neighbor : volume.cells[from].neighbors) {
        if (neighbor < from) links.push_back(&neighbor);
    }
    return links;
}

/// Pairs are compared from their first cell, so that a wrong link back is found by counting only.
TEST_F(ProbeFileTest, VerifyFindsWrongLinksToEarlierCells) {
    size_t tried = 0;
    for (uint32_t from = 2; from < volume.cells.size(); from += 1 + from / 8) {
        ProbeVolume broken = volume;
        const auto links = links_to_earlier_cells(broken, from);
        if (links.empty()) continue;
        const uint32_t other = (*links[0] + 1) % from;
        const uint32_t wrong[] = {from, other, *links.back()};
        for (const uint32_t link : wrong) {
            if (link == volume.cells[from].neighbors[links[0] - &broken.cells[from].neighbors[0]])
                continue;
            *links[0] = link;
            const Status status = verify(broken.view());
            ASSERT_FALSE(status) << "cell " << from << " to " << link;
            EXPECT_EQ(status.error().code, ErrorCode::Corrupt);
            ++tried;
        }
    }
    EXPECT_GT(tried, 20u);
}

/// Readers could take either of the two.
TEST_F(ProbeFileTest, RefusesASectionThatOccursTwice) {
    const std::vector<std::byte> bytes(16);
    const ExtraSection extra{"extra", bytes};
    ASSERT_TRUE(write_file(path, probe_file_bytes(volume.view(), std::array{extra, extra})));
    for (const auto& opened : {open_probe_file(path), open_probe_file_lazy(path)}) {
        ASSERT_FALSE(opened);
        EXPECT_EQ(opened.error().code, ErrorCode::Corrupt);
        EXPECT_EQ(opened.error().field, "extra");
    }
}

TEST_F(ProbeFileTest, AVolumeThatCannotBeReadReplacesNothing) {
    ASSERT_TRUE(write_probe_file(path, volume.view()));
    ProbeVolume broken = volume;
    broken.info.extent = -1.0f;
    const Status status = write_probe_file(path, broken.view());
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::Corrupt);
    EXPECT_EQ(status.error().field, "info.extent");
    EXPECT_TRUE(open_probe_file(path));
}

TEST_F(ProbeFileTest, KeepsTheOldFileWhenTheNewOneCannotBeWritten) {
    ASSERT_TRUE(write_probe_file(path, volume.view()));
    EXPECT_FALSE(write_probe_file(path + "/inside", volume.view()));
    EXPECT_TRUE(open_probe_file(path));
}

}  // namespace
}  // namespace tetralight
