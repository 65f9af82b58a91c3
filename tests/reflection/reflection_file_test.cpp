// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/reflection_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>
#include <tetralight/reflection/sample_reflections.h>
#include "tests/reflection/reflection_fixture.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

using Bytes = std::vector<std::byte>;

template <class T>
T number_at(const Bytes& bytes, size_t offset) {
    T value{};
    std::memcpy(&value, &bytes.at(offset + sizeof value - 1) + 1 - sizeof value, sizeof value);
    return value;
}

template <class T>
void set_number(Bytes& bytes, size_t offset, T value) {
    std::memcpy(&bytes.at(offset), &value, sizeof value);
}

/// Fields of the file by their offsets in the specification of KTX 2.0, section 3.
constexpr size_t kVkFormat = 12, kTypeSize = 16, kWidth = 20, kHeight = 24, kDepth = 28,
                 kLayerCount = 32, kFaceCount = 36, kLevelCount = 40, kSupercompression = 44,
                 kDescriptorOffset = 48, kDescriptorSize = 52, kPairsOffset = 56, kPairsSize = 60,
                 kLevels = 80;

/// Key/value data in its order in the file.
std::vector<std::pair<std::string, std::string>> pairs_of(const Bytes& bytes) {
    std::vector<std::pair<std::string, std::string>> pairs;
    size_t at = number_at<uint32_t>(bytes, kPairsOffset);
    const size_t end = at + number_at<uint32_t>(bytes, kPairsSize);
    while (at < end) {
        const uint32_t length = number_at<uint32_t>(bytes, at);
        const std::string both(reinterpret_cast<const char*>(&bytes.at(at + 4)), length);
        const size_t zero = both.find('\0');
        pairs.emplace_back(both.substr(0, zero), both.substr(zero + 1));
        at += 4 + (length + 3) / 4 * 4;
    }
    EXPECT_EQ(at, end);
    return pairs;
}

class ReflectionFileTest : public testing::Test {
  protected:
    /// The error of opening these bytes; none if they are opened. Samples what is opened.
    std::optional<Error> refused(const Bytes& content) const {
        return refused_file(folder.write("a.ktx2", content));
    }

    static std::optional<Error> refused_file(const std::string& path) {
        const auto file = open_reflection_file(path);
        if (!file) return file.error();
        EXPECT_TRUE(verify(file->view()));
        const ReflectionBlend blend = blend_reflections(file->view(), {0.5, 1.0, -2.0});
        for (const float roughness : {0.0f, 0.6f, 1.0f}) {
            const glm::vec3 light =
                sample_reflections(file->view(), blend, {0.5, 1, -2}, {1, 2, 3}, roughness);
            EXPECT_TRUE(std::isfinite(light.x + light.y + light.z));
        }
        return std::nullopt;
    }

    /// The bytes with one number changed must be refused with this code and field.
    template <class T>
    void expect_refused(size_t offset, T value, ErrorCode code, const std::string& field) const {
        Bytes changed = bytes;
        set_number(changed, offset, value);
        const auto error = refused(changed);
        ASSERT_TRUE(error) << "offset " << offset << " value " << value;
        EXPECT_EQ(error->code, code) << error_text(*error);
        EXPECT_EQ(error->field, field) << error_text(*error);
    }

    const TempFolder folder;
    const Reflections reflections = test::make_small_reflections();
    const Bytes bytes = reflection_file_bytes(reflections);
};

TEST_F(ReflectionFileTest, ReadsBackWhatWasWritten) {
    const std::string path = folder.path("a.ktx2");
    ASSERT_TRUE(write_reflection_file(path, reflections));
    auto opened = open_reflection_file(path);
    ASSERT_TRUE(opened) << error_text(opened.error());
    const ReflectionFile file = std::move(*opened);  // the view must survive a move
    const ReflectionsView& view = file.view();
    EXPECT_EQ(view.size, reflections.size);
    EXPECT_EQ(view.level_count, 2u);
    EXPECT_TRUE(std::ranges::equal(view.probes, reflections.probes));
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_TRUE(std::ranges::equal(view.levels[i], reflections.levels[i])) << i;
    }
    EXPECT_EQ(view.metadata, reflections.metadata);
    const auto names = file.names();
    EXPECT_TRUE(std::ranges::equal(names, reflections.names));
}

TEST_F(ReflectionFileTest, OpensBytesThatGoAfterwards) {
    Bytes gone = bytes;
    auto opened = open_reflection_memory(gone);
    ASSERT_TRUE(opened) << error_text(opened.error());
    gone.assign(gone.size(), std::byte{0xff});
    const ReflectionFile file = std::move(*opened);
    EXPECT_EQ(reflection_file_bytes(file.copy()), bytes);
    const auto refused = open_reflection_memory(gone);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Corrupt);
    EXPECT_TRUE(error_text(refused.error()).starts_with("memory: ")) << error_text(refused.error());
}

TEST_F(ReflectionFileTest, NamesAndMetadataMayBeMissing) {
    Reflections bare = reflections;
    bare.names.clear();
    bare.metadata.clear();
    const std::string path = folder.path("bare.ktx2");
    ASSERT_TRUE(write_reflection_file(path, bare));
    const auto file = open_reflection_file(path);
    ASSERT_TRUE(file) << error_text(file.error());
    EXPECT_TRUE(file->names().empty());
    EXPECT_TRUE(file->view().metadata.empty());
}

TEST_F(ReflectionFileTest, WritesTheBytesOfTheProbes) {
    const std::string path = folder.path("a.ktx2");
    ASSERT_TRUE(write_reflection_file(path, reflections));
    EXPECT_EQ(*read_file(path), bytes);
    EXPECT_EQ(reflection_file_bytes(reflections), bytes);
}

TEST_F(ReflectionFileTest, HasTheHeaderOfAnArrayOfCubes) {
    const uint8_t identifier[]{0xAB, 0x4B, 0x54, 0x58, 0x20, 0x32,
                               0x30, 0xBB, 0x0D, 0x0A, 0x1A, 0x0A};
    EXPECT_EQ(std::memcmp(bytes.data(), identifier, sizeof identifier), 0);
    const std::map<size_t, uint32_t> words{
        {kVkFormat, 97},  {kTypeSize, 2},  {kWidth, 4},      {kHeight, 4},          {kDepth, 0},
        {kLayerCount, 2}, {kFaceCount, 6}, {kLevelCount, 2}, {kSupercompression, 0}};
    for (const auto& [offset, value] : words) {
        EXPECT_EQ(number_at<uint32_t>(bytes, offset), value) << offset;
    }
    EXPECT_EQ(number_at<uint64_t>(bytes, 64), 0u);  // no global data of a supercompression
    EXPECT_EQ(number_at<uint64_t>(bytes, 72), 0u);
}

TEST_F(ReflectionFileTest, HasItsLevelsFromTheSmallestToTheLargest) {
    const auto offset = [&](size_t i) { return number_at<uint64_t>(bytes, kLevels + 24 * i); };
    for (size_t i = 0; i < 2; ++i) {
        const uint64_t size = 2 * 6 * (4u >> i) * (4u >> i) * 8;
        EXPECT_EQ(number_at<uint64_t>(bytes, kLevels + 24 * i + 8), size);
        EXPECT_EQ(number_at<uint64_t>(bytes, kLevels + 24 * i + 16), size);
        EXPECT_EQ(offset(i) % 8, 0u);
        EXPECT_EQ(std::memcmp(&bytes.at(offset(i)), reflections.levels[i].data(), size), 0);
    }
    EXPECT_EQ(offset(0), offset(1) + 2 * 6 * 4 * 8);
    EXPECT_EQ(bytes.size(), offset(0) + 2 * 6 * 16 * 8);
}

TEST_F(ReflectionFileTest, DescribesFourLinearHalves) {
    const size_t at = number_at<uint32_t>(bytes, kDescriptorOffset);
    EXPECT_EQ(at, kLevels + 2 * 24);
    EXPECT_EQ(number_at<uint32_t>(bytes, kDescriptorSize), 92u);
    EXPECT_EQ(number_at<uint32_t>(bytes, at), 92u);     // dfdTotalSize
    EXPECT_EQ(number_at<uint32_t>(bytes, at + 4), 0u);  // Khronos, basic format
    EXPECT_EQ(number_at<uint32_t>(bytes, at + 8), 88u << 16 | 2u);
    EXPECT_EQ(number_at<uint32_t>(bytes, at + 12), 0x00010101u);  // RGBSDA, BT.709, linear
    EXPECT_EQ(number_at<uint32_t>(bytes, at + 16), 0u);           // blocks of one texel
    EXPECT_EQ(number_at<uint64_t>(bytes, at + 20), 8u);           // of 8 bytes
    const uint32_t channels[]{0, 1, 2, 15};
    for (uint32_t i = 0; i < 4; ++i) {
        const size_t sample = at + 28 + 16 * i;
        EXPECT_EQ(number_at<uint32_t>(bytes, sample),
                  (channels[i] | 0xc0u) << 24 | 15u << 16 | 16u * i);  // float, signed
        EXPECT_EQ(number_at<float>(bytes, sample + 8), -1.0f);
        EXPECT_EQ(number_at<float>(bytes, sample + 12), 1.0f);
    }
}

TEST_F(ReflectionFileTest, HasItsKeysInOrder) {
    const auto pairs = pairs_of(bytes);
    std::vector<std::string> keys;
    for (const auto& [key, value] : pairs) keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"KTXorientation", "KTXwriter", "tetralight",
                                              "tetralightMetadata", "tetralightNames",
                                              "tetralightReflections"}));
    EXPECT_TRUE(std::ranges::is_sorted(keys));
    EXPECT_EQ(pairs[0].second, std::string("rd\0", 3));
    EXPECT_EQ(pairs[2].second.front(), '{');
    EXPECT_EQ(pairs[2].second.substr(pairs[2].second.size() - 2), std::string("}\0", 2));
    EXPECT_EQ(pairs[3].second, reflections.metadata);
    EXPECT_EQ(pairs[4].second, "hall \"A\"\nsky\\dome é\n");
    ASSERT_EQ(pairs[5].second.size(), 2 * sizeof(ReflectionProbe));
    EXPECT_EQ(std::memcmp(pairs[5].second.data(), reflections.probes.data(), 432), 0);
}

/// ktx-parse, the reader of JavaScript engines, where `./run test` could install it.
TEST_F(ReflectionFileTest, ReadsBackByKtxParse) {
    const std::string modules = TETRALIGHT_NODE_MODULES;
    if (!std::filesystem::exists(modules + "/ktx-parse/package.json")) {
        GTEST_SKIP() << "npm has not installed ktx-parse";
    }
    std::string command = "node " TETRALIGHT_SOURCE_DIR "/tests/reflection/read_reflections.mjs " +
                          modules + " " + folder.write("a.ktx2", bytes);
    for (size_t i = 0; i < 2; ++i) {
        command +=
            " " + folder.write(std::to_string(i), std::as_bytes(std::span(reflections.levels[i])));
    }
    EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(ReflectionFileTest, RefusesAFileCutAtAnyLength) {
    const std::string path = folder.write("a.ktx2", bytes);
    for (size_t length = bytes.size(); length-- > 0;) {
        std::filesystem::resize_file(path, length);
        const auto error = refused_file(path);
        ASSERT_TRUE(error) << length;
        ASSERT_EQ(error->code, ErrorCode::Corrupt) << length;
    }
}

TEST_F(ReflectionFileTest, AnyByteChangedGivesAnErrorOrASoundView) {
    const std::string path = folder.write("a.ktx2", bytes);
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    const auto write_byte = [&](size_t i, std::byte byte) {
        file.seekp(static_cast<std::streamoff>(i));
        file.put(static_cast<char>(byte)).flush();
    };
    size_t refused_count = 0;
    for (size_t i = 0; i < bytes.size(); ++i) {
        for (const auto flip : {std::byte{0x01}, std::byte{0x80}, std::byte{0xff}}) {
            write_byte(i, bytes[i] ^ flip);
            refused_count += refused_file(path) ? 1 : 0;
        }
        write_byte(i, bytes[i]);
    }
    EXPECT_FALSE(refused_file(path));
    EXPECT_GT(refused_count, 500u);
}

TEST_F(ReflectionFileTest, RefusesTexturesOfOtherKinds) {
    const auto other = ErrorCode::Unsupported;
    expect_refused(kVkFormat, 109u, other, "vk_format");
    expect_refused(kSupercompression, 2u, other, "supercompression");
    expect_refused(kFaceCount, 1u, other, "face_count");
    expect_refused(kLayerCount, 0u, other, "face_count");
    expect_refused(kDepth, 4u, other, "face_count");
    Bytes foreign = bytes;
    const std::string key = "tetralightReflections";
    const auto found =
        std::search(foreign.begin(), foreign.end(), reinterpret_cast<const std::byte*>(key.data()),
                    reinterpret_cast<const std::byte*>(key.data()) + key.size());
    ASSERT_NE(found, foreign.end());
    *found = std::byte{'T'};
    const auto error = refused(foreign);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code, other);
    EXPECT_EQ(error->field, key);
}

TEST_F(ReflectionFileTest, RefusesSizesThatDoNotFit) {
    const auto wrong = ErrorCode::Corrupt;
    expect_refused(kTypeSize, 4u, wrong, "type_size");
    expect_refused(kWidth, 8u, wrong, "size");
    expect_refused(kLayerCount, 3u, wrong, "levels[0]");
    expect_refused(kLayerCount, kMaxReflectionCubes + 1, wrong, "layer_count");
    expect_refused(kLevelCount, 0u, wrong, "level_count");
    expect_refused(kLevelCount, 4u, wrong, "level_count");
    expect_refused(kLevelCount, 3u, wrong, "levels[2]");  // its entry is the descriptor
    expect_refused(kDescriptorSize, 93u, wrong, "descriptor");
    expect_refused(kDescriptorOffset, UINT32_MAX, wrong, "descriptor");
    expect_refused(kPairsOffset, UINT32_MAX, wrong, "metadata");
    expect_refused(kPairsSize, UINT32_MAX, wrong, "metadata");
    expect_refused(kPairsSize, 3u, wrong, "metadata");
    const uint64_t end = bytes.size();
    for (const uint64_t offset : {end, end - 8, UINT64_MAX - 7, UINT64_MAX, uint64_t{1} << 63}) {
        expect_refused(kLevels, offset, wrong, "levels[0]");
    }
    expect_refused(kLevels, number_at<uint64_t>(bytes, kLevels) - 2, wrong, "levels[0]");
    expect_refused(kLevels + 8, UINT64_MAX, wrong, "levels[0]");
    expect_refused(kLevels + 24 + 16, uint64_t{1}, wrong, "levels[1]");
}

TEST_F(ReflectionFileTest, RefusesPairsThatDoNotFit) {
    const size_t first = number_at<uint32_t>(bytes, kPairsOffset);
    expect_refused(first, UINT32_MAX, ErrorCode::Corrupt, "metadata");
    expect_refused(first, 0u, ErrorCode::Corrupt, "metadata");  // no key
    // Two keys of 4 bytes more or less: the rest is read from the middle of a pair.
    Bytes twice = bytes;
    const std::string names = "tetralightNames", metadata = "tetralightMetadata";
    std::string text(reinterpret_cast<const char*>(twice.data()), twice.size());
    text.replace(text.find(metadata), metadata.size() + 1, names + std::string(4, '\0'));
    std::memcpy(twice.data(), text.data(), text.size());
    const auto error = refused(twice);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->field, names);
    EXPECT_EQ(error_text(*error), folder.path("a.ktx2") + ": key \"tetralightNames\" occurs twice");
}

TEST_F(ReflectionFileTest, RefusesOtherFiles) {
    const auto text = refused(Bytes(500, std::byte{'x'}));
    ASSERT_TRUE(text);
    EXPECT_EQ(error_text(*text),
              folder.path("a.ktx2") + ": not a KTX 2.0 file (wrong first bytes)");
    const auto missing = open_reflection_file(folder.path("missing.ktx2"));
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::NotFound);
}

/// The field of the error of writing; the old file must stay.
class RefusedWrite : public ReflectionFileTest {
  protected:
    [[nodiscard]] std::string field_of(const Reflections& wrong) const {
        const std::string path = folder.write("old.ktx2", "old");
        const Status status = write_reflection_file(path, wrong);
        EXPECT_EQ(read_file(path)->size(), 3u);
        if (status) return "";
        EXPECT_EQ(status.error().code, ErrorCode::InvalidArgument);
        return status.error().field;
    }
};

TEST_F(RefusedWrite, NamesWhatIsWrong) {
    Reflections wrong = reflections;
    wrong.names.pop_back();
    EXPECT_EQ(field_of(wrong), "names");
    wrong = reflections;
    wrong.names[1] = "line\nbreak";
    EXPECT_EQ(field_of(wrong), "name");
    wrong = reflections;
    wrong.probes[1].blend_distance = -1.0f;
    EXPECT_EQ(field_of(wrong), "probes[1].blend_distance");
    wrong = reflections;
    wrong.levels.resize(kMaxReflectionLevels + 1);
    EXPECT_EQ(field_of(wrong), "levels");
}

TEST_F(ReflectionFileTest, LayersComeBack) {
    const Reflections all = test::make_layered_reflections();
    const std::string path = folder.path("layers.ktx2");
    ASSERT_TRUE(write_reflection_file(path, all));
    const auto file = open_reflection_file(path);
    ASSERT_TRUE(file) << error_text(file.error());
    EXPECT_EQ(file->view().probes.size(), 2u);
    const Reflections copy = file->copy();
    EXPECT_EQ(copy.layers, all.layers);
    EXPECT_EQ(copy.layer_names, all.layer_names);
    EXPECT_EQ(copy.layer_irradiance, all.layer_irradiance);
    EXPECT_EQ(copy.levels, all.levels);
    EXPECT_EQ(copy.layer_levels, all.layer_levels);
    EXPECT_EQ(reflection_file_bytes(copy), reflection_file_bytes(all));
    EXPECT_EQ(number_at<uint32_t>(reflection_file_bytes(all), kLayerCount), 6u);
}

TEST_F(ReflectionFileTest, AChangedByteOfLayersGivesAnErrorOrASoundView) {
    const Bytes layered = reflection_file_bytes(test::make_layered_reflections());
    const size_t begin = number_at<uint32_t>(layered, kPairsOffset);
    const size_t end = begin + number_at<uint32_t>(layered, kPairsSize);
    for (size_t i = begin; i < end; i += 5) {
        Bytes changed = layered;
        changed[i] ^= std::byte{0x81};
        (void)refused(changed);  // samples what is opened
    }
    Bytes fewer = layered;
    set_number(fewer, kLayerCount, uint32_t{5});
    EXPECT_TRUE(refused(fewer));
}

}  // namespace
}  // namespace tetralight
