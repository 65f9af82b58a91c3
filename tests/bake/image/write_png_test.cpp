// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/error_text.h>
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

TEST(WritePng, PixelsComeBack) {
    const TempFolder folder;
    Image8 image{3, 2, {}};
    for (uint8_t i = 0; i < 6; ++i) {
        image.pixels.push_back(
            {i, static_cast<uint8_t>(40 * i), 200, static_cast<uint8_t>(255 - i)});
    }
    ASSERT_TRUE(write_png(folder.path("a.png"), image));
    const auto bytes = read_file(folder.path("a.png"));
    const auto decoded = decode_image8(*bytes, "a.png");
    ASSERT_TRUE(decoded);
    EXPECT_EQ(*decoded, image);
}

TEST(WritePng, RejectsAnEmptyImage) {
    const auto status = write_png("/tmp/never.png", {});
    ASSERT_FALSE(status);
    EXPECT_EQ(error_text(status.error()), "/tmp/never.png: cannot write an image of 0 x 0 pixels");
}

TEST(WritePng, NamesAFolderThatIsMissing) {
    const TempFolder folder;
    const auto status = write_png(folder.path("none/a.png"), Image8{1, 1, {{1, 2, 3, 4}}});
    ASSERT_FALSE(status);
    EXPECT_NE(error_text(status.error()).find("none/a.png"), std::string::npos);
}

TEST(WritePng, TextsStandBehindTheHeaderWithTheirChecksum) {
    const Image8 image{1, 1, {{1, 2, 3, 4}}};
    const auto bytes = encode_png(image, {{"a", "b"}});
    ASSERT_TRUE(bytes);
    // The CRC-32 of "tEXta\0b", by Python's zlib.
    const std::string chunk("\0\0\0\3tEXta\0b\xdc\x49\xa2\x3b", 15);
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    EXPECT_EQ(text.substr(33, 15), chunk);
    EXPECT_EQ(*decode_image8(*bytes, "a.png"), image);
}

}  // namespace
}  // namespace tetralight
