// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/read_image.h>

#include <gtest/gtest.h>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/error_text.h>
#include "tests/support/image_files.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

std::vector<std::byte> small_png() {
    const TempFolder folder;
    EXPECT_TRUE(write_png(folder.path("a.png"), Image8{2, 1, {{255, 0, 0, 255}, {0, 9, 0, 128}}}));
    return *read_file(folder.path("a.png"));
}

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

TEST(DecodeImage8, RejectsOtherFormats) {
    const auto image = decode_image8(bytes_of("GIF89a"), "photo.gif");
    ASSERT_FALSE(image);
    EXPECT_EQ(error_text(image.error()), "photo.gif: is neither a PNG nor a JPEG nor a WebP image");
}

TEST(DecodeImage8, RejectsEveryTruncationOfAPng) {
    const auto png = small_png();
    for (size_t length = 0; length < png.size() - 4; ++length) {  // the last 4 are a checksum
        const auto image = decode_image8(std::span(png).first(length), "cut.png");
        ASSERT_FALSE(image) << length;
        EXPECT_TRUE(error_text(image.error()).starts_with("cut.png: "));
    }
}

TEST(DecodeImage8, RejectsASizeAboveTheCapBeforeDecoding) {
    auto png = small_png();
    const uint8_t size[] = {0, 0, 0x80, 0, 0, 0, 0x80, 0};  // 32768 x 32768, big-endian
    constexpr size_t kWidthOffset = 16;
    for (size_t i = 0; i < sizeof size; ++i) png[kWidthOffset + i] = std::byte{size[i]};
    const auto image = decode_image8(png, "bomb.png");
    ASSERT_FALSE(image);
    EXPECT_EQ(error_text(image.error()),
              "bomb.png: 32768 x 32768 pixels are more than the largest size (268435456 pixels)");
}

TEST(DecodeImage8, TellsTheFormatByContent) {
    const std::string jpeg = test::constant_jpeg({200});
    const auto image = decode_image8(bytes_of(jpeg), "named.png");
    ASSERT_TRUE(image) << error_text(image.error());
    EXPECT_EQ(image->pixels[63], (std::array<uint8_t, 4>{200, 200, 200, 255}));
}

TEST(DecodeImage8, NamesAWebpImageThatIsDamaged) {
    const auto image = decode_image8(bytes_of("RIFFabcdWEBPnone"), "a.webp");
    ASSERT_FALSE(image);
    EXPECT_TRUE(error_text(image.error()).starts_with("a.webp: cannot decode image ("));
}

TEST(ReadImageSize, IsThatOfTheDecodedImage) {
    EXPECT_EQ(*read_image_size(small_png(), "a.png"), (ImageSize{2, 1}));
    const std::string jpeg = test::constant_jpeg({1, 2, 3}, {.sampling = 2});
    EXPECT_EQ(*read_image_size(bytes_of(jpeg), "a.jpg"), (ImageSize{16, 16}));
}

TEST(ReadImageSize, NamesWhatIsWrong) {
    const auto other = read_image_size(bytes_of("GIF89a"), "photo.gif");
    ASSERT_FALSE(other);
    EXPECT_EQ(error_text(other.error()), "photo.gif: is neither a PNG nor a JPEG nor a WebP image");
    const auto large = read_image_size(bytes_of(test::png_file({20000, 20000}, "")), "a.png");
    ASSERT_FALSE(large);
    EXPECT_EQ(error_text(large.error()),
              "a.png: 20000 x 20000 pixels are more than the largest size (268435456 pixels)");
}

TEST(ReadHdrImageSize, IsReadOfBothFormats) {
    const TempFolder folder;
    ASSERT_TRUE(write_exr(folder.path("a.exr"), ImageF{3, 2, std::vector<glm::vec3>(6)}));
    EXPECT_EQ(*read_hdr_image_size(folder.path("a.exr")), (ImageSize{3, 2}));
    const auto path = folder.write("a.hdr", test::radiance_file("-Y 7 +X 9", ""));
    EXPECT_EQ(*read_hdr_image_size(path), (ImageSize{9, 7}));
    const auto other = read_hdr_image_size(folder.write("a.txt", "hello"));
    ASSERT_FALSE(other);
    EXPECT_TRUE(error_text(other.error()).starts_with(folder.path("a.txt")));
}

TEST(ReadHdrImage, DecodesRadianceRgbe) {
    const TempFolder folder;
    // (128, 64, 32) / 256 * 2^(130 - 128) = (2, 1, 0.5); exponent 0 is black.
    const std::string rgbe("\x80\x40\x20\x82\x00\x00\x00\x00", 8);
    const auto path = folder.write("a.hdr", test::radiance_file("-Y 1 +X 2", rgbe));
    const auto read = read_hdr_image(path);
    ASSERT_TRUE(read) << error_text(read.error());
    EXPECT_EQ(read->image.width, 2u);
    EXPECT_EQ(read->image.pixels, (std::vector<glm::vec3>{{2.0f, 1.0f, 0.5f}, {0, 0, 0}}));
}

TEST(ReadHdrImage, TellsTheKindByContentNotByName) {
    const TempFolder folder;
    ASSERT_TRUE(write_exr(folder.path("named.hdr"), ImageF{1, 1, {{1, 2, 3}}}));
    const auto read = read_hdr_image(folder.path("named.hdr"));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->image.pixels[0], glm::vec3(1, 2, 3));
}

TEST(ReadHdrImage, RejectsARadianceSizeAboveTheCap) {
    const TempFolder folder;
    const auto path = folder.write("large.hdr", test::radiance_file("-Y 100000 +X 100000", ""));
    const auto read = read_hdr_image(path);
    ASSERT_FALSE(read);
    EXPECT_NE(error_text(read.error()).find("100000 x 100000 pixels"), std::string::npos);
}

TEST(ReadHdrImage, RejectsACutOffRadianceFile) {
    const TempFolder folder;
    const auto path = folder.write("cut.hdr", test::radiance_file("-Y 4 +X 2", "\x80\x40\x20\x82"));
    const auto read = read_hdr_image(path);
    ASSERT_FALSE(read);
    EXPECT_TRUE(error_text(read.error()).starts_with(path));
}

TEST(ReadHdrImage, RejectsOtherFiles) {
    const TempFolder folder;
    const auto path = folder.write("a.hdr", "hello");
    const auto read = read_hdr_image(path);
    ASSERT_FALSE(read);
    EXPECT_EQ(error_text(read.error()), path + ": is neither a Radiance .hdr nor an OpenEXR image");
}

TEST(ReadHdrImage, NamesAFileThatIsMissing) {
    const auto read = read_hdr_image("/nowhere/sky.hdr");
    ASSERT_FALSE(read);
    EXPECT_NE(error_text(read.error()).find("/nowhere/sky.hdr"), std::string::npos);
}

}  // namespace
}  // namespace tetralight
