// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/bake/image/write_image.h>
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

TEST(WriteExr, FloatsComeBackBitForBit) {
    const TempFolder folder;
    ImageF image{3, 2, {}};
    for (int i = 0; i < 6; ++i) {
        const auto value = static_cast<float>(i);
        image.pixels.emplace_back(value * 0.1f, value * 1e6f, value * 1e-20f);
    }
    ASSERT_TRUE(write_exr(folder.path("a.exr"), image));
    const auto read = read_hdr_image(folder.path("a.exr"));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->image, image);
    EXPECT_EQ(read->mended_pixel_count, 0u);
}

TEST(WriteExr, RejectsAnEmptyImage) {
    EXPECT_FALSE(write_exr("/tmp/never.exr", {}));
}

TEST(WriteExr, KeepsTheOldFileWhereItCannotWrite) {
    const TempFolder folder;
    const std::string path = folder.write("a.exr", "old");
    EXPECT_FALSE(write_exr(path, ImageF{0, 4, {}}));
    EXPECT_EQ(read_file(path)->size(), 3u);
}

}  // namespace
}  // namespace tetralight
