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

}  // namespace
}  // namespace tetralight
