// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lightmap_images.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/base/file.h>
#include <tetralight/base/half.h>
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

/// Pages of 2 × 2 texels with these red values times `scale`, all covered.
Lightmaps pages_of(const std::vector<float>& red, float scale = 1.0f) {
    Lightmaps maps;
    maps.info.page_size = 2;
    maps.info.page_count = static_cast<uint32_t>(red.size() / 4);
    maps.info.scale = scale;
    for (const float value : red)
        maps.irradiance.push_back({{half_from_float(value), 0, 0}, kCovered});
    return maps;
}

ExportedTexels irradiance_of(const Lightmaps& maps) {
    return *map_values(maps.view(), LightmapMap::Irradiance);
}

TEST(LightmapImages, RgbmKeepsTheLargestChannelToAPart) {
    for (const RgbmCurve curve : {RgbmCurve::Linear, RgbmCurve::ThirdRoom}) {
        ImageF image{100, 1, {}};
        for (int i = 0; i < 100; ++i) {
            const float value = 50.0f * static_cast<float>(i) / 99.0f;
            image.pixels.emplace_back(value, 0.25f * value, 0.0f);
        }
        const Image8 encoded = encode_rgbm(image, 50.0f, curve);
        for (size_t i = 0; i < 100; ++i) {
            const glm::vec3 decoded = decode_rgbm(encoded.pixels[i], 50.0f, curve);
            const float red = image.pixels[i].x;
            EXPECT_NEAR(decoded.x, red, 0.005f * red + 0.001f) << i;
            EXPECT_NEAR(decoded.y, 0.25f * red, 0.005f * red + 0.001f) << i;
            EXPECT_EQ(decoded.z, 0.0f);
        }
    }
}

TEST(LightmapImages, ThirdRoomDecodesAsTheDraftOfMxLightmap) {
    // E = 34.49 · a^2.2 · rgb of an sRGB image.
    const glm::vec3 white = decode_rgbm({255, 255, 255, 128}, 34.49f, RgbmCurve::ThirdRoom);
    EXPECT_NEAR(white.x, 34.49f * std::pow(128.0f / 255.0f, 2.2f), 1e-4f);
    const glm::vec3 grey = decode_rgbm({128, 0, 0, 255}, 34.49f, RgbmCurve::ThirdRoom);
    EXPECT_NEAR(grey.x, 34.49f * 0.21586f, 1e-3f);
}

TEST(LightmapImages, PagePathsHaveNumbersIfThereAreSeveral) {
    EXPECT_EQ(page_path("a.b/c.exr", 0, 1), "a.b/c.exr");
    EXPECT_EQ(page_path("a.b/c.exr", 2, 3), "a.b/c_2.exr");
    EXPECT_EQ(page_path("a.b/c", 2, 3), "a.b/c_2");
}

TEST(LightmapImages, ExrHasTheIrradianceOfEachPage) {
    const TempFolder folder;
    const Lightmaps maps = pages_of({1, 2, 3, 4, 5, 6, 7, 8}, 256.0f);
    ASSERT_TRUE(write_exr_pages(folder.path("a.exr"), irradiance_of(maps)));
    const auto second = read_hdr_image(folder.path("a_1.exr"));
    ASSERT_TRUE(second);
    ASSERT_EQ(second->image.pixels.size(), 4u);
    EXPECT_EQ(second->image.pixels[1], glm::vec3(6 * 256, 0, 0));
}

TEST(LightmapImages, PngSaysItsRange) {
    const TempFolder folder;
    const Lightmaps maps = pages_of({1, 2, 3, 4}, 4.0f);
    const auto range = write_png_pages(folder.path("a.png"), irradiance_of(maps));
    ASSERT_TRUE(range);
    EXPECT_EQ(*range, 16.0f);
    const auto bytes = read_file(folder.path("a.png"));
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    EXPECT_NE(text.find(R"({"encoding":"rgbm","range":16})"), std::string::npos);
    const auto image = decode_image8(*bytes, "a.png");
    ASSERT_TRUE(image);
    EXPECT_NEAR(decode_rgbm(image->pixels[2], 16.0f, RgbmCurve::Linear).x, 12.0f, 0.05f);
}

TEST(LightmapImages, Ktx2HasAScaleOnlyForLightThatHalvesCannotHold) {
    const TempFolder folder;
    const std::string path = folder.path("a.ktx2");
    const Lightmaps dim = pages_of({1, 2, 3, 4}, 4.0f);
    EXPECT_EQ(*write_ktx2_pages(path, irradiance_of(dim)), 1.0f);
    const auto bytes = read_file(path);
    uint16_t red = 0;
    std::memcpy(&red, bytes->data() + bytes->size() - 8, sizeof red);
    EXPECT_EQ(float_from_half(red), 16.0f);
    const Lightmaps bright = pages_of({1, 2, 3, 30000}, 4.0f);
    EXPECT_EQ(*write_ktx2_pages(path, irradiance_of(bright)), 4.0f);
}

/// Two pages of one texel with four fractions.
ExportedTexels fractions() {
    ExportedTexels values;
    values.page_size = 1;
    values.page_count = 2;
    values.channel_count = 4;
    values.is_fraction = true;
    values.at = [](size_t texel) { return glm::vec4(0.0f, 1.0f, 0.2f, texel == 0 ? 0.4f : 1.0f); };
    return values;
}

TEST(LightmapImages, FractionsArePlainBytes) {
    const TempFolder folder;
    ASSERT_TRUE(write_png_pages(folder.path("a.png"), fractions()));
    const auto bytes = read_file(folder.path("a_0.png"));
    const auto image = decode_image8(*bytes, "a_0.png");
    ASSERT_TRUE(image);
    EXPECT_EQ(image->pixels[0], (std::array<uint8_t, 4>{0, 255, 51, 102}));
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    EXPECT_EQ(text.find("rgbm"), std::string::npos);
}

TEST(LightmapImages, ExrAndKtx2HaveFourChannels) {
    const TempFolder folder;
    ASSERT_TRUE(write_exr_pages(folder.path("a.exr"), fractions()));
    const auto header = read_file(folder.path("a_1.exr"));
    const std::string text(reinterpret_cast<const char*>(header->data()), header->size());
    EXPECT_NE(text.find(std::string("A\0", 2)), std::string::npos);
    ASSERT_TRUE(write_ktx2_pages(folder.path("a.ktx2"), fractions()));
    const auto bytes = read_file(folder.path("a.ktx2"));
    uint16_t last[8];  // two layers of four halves
    std::memcpy(last, bytes->data() + bytes->size() - sizeof last, sizeof last);
    EXPECT_NEAR(float_from_half(last[3]), 0.4f, 1e-3f);
    EXPECT_EQ(float_from_half(last[7]), 1.0f);
}

TEST(LightmapImages, PngHoldsNoLightInFourChannels) {
    const TempFolder folder;
    ExportedTexels values = fractions();
    values.is_fraction = false;
    EXPECT_FALSE(write_png_pages(folder.path("a.png"), values));
    EXPECT_FALSE(read_file(folder.path("a_0.png")));
}

}  // namespace
}  // namespace tetralight
