// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/write_layered_exr.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

struct Pixel {
    float a;
    float unused;
    float b;
};

LayeredImage make_image(const std::vector<Pixel>& pixels) {
    return {3,
            2,
            {{"sh0.R", &pixels[0].a, sizeof(Pixel)}, {"sh1.G", &pixels[0].b, sizeof(Pixel)}},
            {{"layout", "slices"}}};
}

std::vector<Pixel> make_pixels(float scale) {
    std::vector<Pixel> pixels;
    for (int i = 0; i < 6; ++i) {
        const auto value = scale * static_cast<float>(i);
        pixels.push_back({value, -1.0f, -0.5f * value});
    }
    return pixels;
}

/// A channel of a file, as OpenEXR reads it.
std::vector<float> read_channel(const std::string& path, const char* name) {
    Imf::InputFile file(path.c_str());
    std::vector<float> values(6);
    Imf::FrameBuffer target;
    target.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()),
                                   sizeof(float), 3 * sizeof(float)));
    file.setFrameBuffer(target);
    file.readPixels(0, 1);
    return values;
}

TEST(WriteLayeredExr, FloatsComeBackBitForBit) {
    const TempFolder folder;
    const auto pixels = make_pixels(0.1f);
    const std::string path = folder.path("a.exr");
    ASSERT_TRUE(write_layered_exr(path, make_image(pixels), ExrPrecision::Float));
    const auto a = read_channel(path, "sh0.R"), b = read_channel(path, "sh1.G");
    for (size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(a[i], pixels[i].a);
        EXPECT_EQ(b[i], pixels[i].b);
    }
    const Imf::InputFile file(path.c_str());
    EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("layout").value(), "slices");
}

TEST(WriteLayeredExr, HalvesRoundAndSaturate) {
    const TempFolder folder;
    const auto pixels = make_pixels(30000.0f);
    const std::string path = folder.path("a.exr");
    ASSERT_TRUE(write_layered_exr(path, make_image(pixels), ExrPrecision::Half));
    EXPECT_EQ(Imf::InputFile(path.c_str()).header().channels()["sh0.R"].type, Imf::HALF);
    const auto a = read_channel(path, "sh0.R");
    EXPECT_EQ(a[2], 60000.0f);
    EXPECT_EQ(a[5], 65504.0f);
}

TEST(WriteLayeredExr, RefusesEmptyImagesAndKeepsTheOldFile) {
    const TempFolder folder;
    const std::string path = folder.write("a.exr", "old");
    EXPECT_FALSE(write_layered_exr(path, {}, ExrPrecision::Float));
    EXPECT_EQ(read_file(path)->size(), 3u);
    const auto pixels = make_pixels(1.0f);
    EXPECT_FALSE(write_layered_exr("/dev/full", make_image(pixels), ExrPrecision::Float));
}

}  // namespace
}  // namespace tetralight
