// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/texture_3d.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

std::vector<std::byte> make_texels(size_t count) {
    std::vector<std::byte> texels(count);
    for (size_t i = 0; i < count; ++i) texels[i] = static_cast<std::byte>(i * 7);
    return texels;
}

uint32_t word(const std::vector<std::byte>& bytes, size_t offset) {
    uint32_t value = 0;
    std::memcpy(&value, &bytes.at(offset), sizeof value);
    return value;
}

/// 5 × 3 × 2 texels.
template <class Write>
std::vector<std::byte> written(TexelFormat format, const std::vector<std::byte>& texels,
                               Write write) {
    const TempFolder folder;
    const std::string path = folder.path("a");
    EXPECT_TRUE(write(path, Texture3dView{5, 3, 2, format, texels}));
    return *read_file(path);
}

TEST(WriteDds, HasTheHeaderOfAVolumeTexture) {
    for (const auto& [format, size, dxgi] :
         {std::tuple{TexelFormat::Rgba16Float, 8u, 10u}, {TexelFormat::Rgba32Float, 16u, 2u}}) {
        const auto texels = make_texels(30 * size);
        const auto file = written(format, texels, write_dds);
        ASSERT_EQ(file.size(), 148u + texels.size());
        EXPECT_EQ(std::memcmp(file.data(), "DDS ", 4), 0);
        EXPECT_EQ(word(file, 4), 124u);
        EXPECT_EQ(word(file, 8) & 0x801007u, 0x801007u);  // caps, sizes, format and depth are there
        EXPECT_EQ(word(file, 12), 3u);                    // height
        EXPECT_EQ(word(file, 16), 5u);                    // width
        EXPECT_EQ(word(file, 20), 5u * size);             // bytes of a row
        EXPECT_EQ(word(file, 24), 2u);                    // depth
        EXPECT_EQ(word(file, 76), 32u);                   // size of the pixel format
        EXPECT_EQ(std::memcmp(&file[84], "DX10", 4), 0);
        EXPECT_EQ(word(file, 112), 0x200000u);  // caps 2: volume
        EXPECT_EQ(word(file, 128), dxgi);
        EXPECT_EQ(word(file, 132), 4u);  // a 3D texture
        EXPECT_EQ(word(file, 140), 1u);  // array size
        EXPECT_EQ(std::memcmp(&file[148], texels.data(), texels.size()), 0);
    }
}

TEST(WriteKtx2, AlignsItsTexels) {
    for (const auto& [format, size] :
         {std::pair{TexelFormat::Rgba16Float, 8u}, {TexelFormat::Rgba32Float, 16u}}) {
        const auto texels = make_texels(30 * size);
        for (const char* value : {"", "1", "12", "123", "1234"}) {
            const auto file =
                written(format, texels, [&](const std::string& path, const Texture3dView& view) {
                    return write_ktx2(path, view, {{"key", value}});
                });
            const uint32_t offset = word(file, 80);
            EXPECT_EQ(offset % size, 0u);
            ASSERT_EQ(file.size(), offset + texels.size());
            EXPECT_EQ(std::memcmp(&file[offset], texels.data(), texels.size()), 0);
        }
    }
}

TEST(WriteKtx2, ArraysHaveLayersAndNoDepth) {
    const auto texels = make_texels(30 * 8);
    const auto file = written(TexelFormat::Rgba16Float, texels,
                              [](const std::string& path, const Texture3dView& view) {
                                  return write_ktx2_array(path, view, {});
                              });
    EXPECT_EQ(word(file, 20), 5u);
    EXPECT_EQ(word(file, 24), 3u);
    EXPECT_EQ(word(file, 28), 0u);  // depth
    EXPECT_EQ(word(file, 32), 2u);  // layers
    const std::string text(reinterpret_cast<const char*>(file.data()), file.size());
    EXPECT_NE(text.find(std::string("KTXorientation\0rd\0", 18)), std::string::npos);
    EXPECT_EQ(std::memcmp(&file[word(file, 80)], texels.data(), texels.size()), 0);
}

TEST(Texture3d, RefusesEmptyTexturesAndKeepsTheOldFile) {
    const TempFolder folder;
    const std::string path = folder.write("a", "old");
    const Texture3dView empty{4, 0, 2, TexelFormat::Rgba16Float, {}};
    const auto status = write_dds(path, empty);
    ASSERT_FALSE(status);
    EXPECT_EQ(error_text(status.error()), path + ": cannot write a texture of 4 x 0 x 2 texels");
    EXPECT_FALSE(write_ktx2(path, empty, {}));
    EXPECT_EQ(read_file(path)->size(), 3u);
}

/// ktx-parse, the reader of JavaScript engines, where `./run test` could install it.
TEST(WriteKtx2, ReadsBackByKtxParse) {
    const std::string module = TETRALIGHT_NODE_MODULES "/ktx-parse/package.json";
    if (!std::filesystem::exists(module)) GTEST_SKIP() << "npm has not installed ktx-parse";
    const TempFolder folder;
    for (const auto& [format, size] :
         {std::pair{TexelFormat::Rgba16Float, 8u}, {TexelFormat::Rgba32Float, 16u}}) {
        const auto texels = make_texels(30 * size);
        const std::string path = folder.path("a.ktx2");
        ASSERT_TRUE(write_ktx2(path, {5, 3, 2, format, texels},
                               {{"tetralight", R"({"layout":"four slabs"})"}}));
        folder.write("texels", texels);
        const std::string command = "node " TETRALIGHT_SOURCE_DIR
                                    "/tests/bake/image/read_ktx2.mjs " TETRALIGHT_NODE_MODULES " " +
                                    path + " " + folder.path("texels") + " " + std::to_string(size);
        EXPECT_EQ(std::system(command.c_str()), 0);
    }
}

}  // namespace
}  // namespace tetralight
