// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/decode_hdr.h>

#include <gtest/gtest.h>

#include <string>

#include <tetralight/base/error_text.h>
#include "tests/support/image_files.h"

namespace tetralight {
namespace {

using test::radiance_file;

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

/// (128, 64, 32) / 256 * 2^(130 - 128)
const glm::vec3 kColor(2.0f, 1.0f, 0.5f);
const std::string kPixel("\x80\x40\x20\x82", 4);

/// A line of 8 pixels of that colour, run-length encoded.
std::string encoded_line() {
    const std::string literal_red("\x08\x80\x80\x80\x80\x80\x80\x80\x80", 9);
    const std::string runs("\x88\x40\x88\x20\x88\x82", 6);  // 136 = eight of the next byte
    return std::string("\x02\x02\x00\x08", 4) + literal_red + runs;
}

std::vector<glm::vec3> pixels_of(const std::string& file) {
    const auto image = detail::decode_hdr(bytes_of(file));
    EXPECT_TRUE(image) << error_text(image.error());
    return image ? image->pixels : std::vector<glm::vec3>();
}

std::string error_of(const std::string& file) {
    const auto image = detail::decode_hdr(bytes_of(file));
    return image ? "no error" : error_text(image.error());
}

TEST(DecodeHdr, FlatPixels) {
    const std::string black("\x80\x40\x20\x00", 4), dark("\x01\x02\x03\x01", 4);
    EXPECT_EQ(pixels_of(radiance_file("-Y 1 +X 3", kPixel + black + dark)),
              (std::vector{kColor, glm::vec3(0.0f), glm::vec3(0x1p-135f, 0x2p-135f, 0x3p-135f)}));
}

TEST(DecodeHdr, RunLengthLines) {
    EXPECT_EQ(pixels_of(radiance_file("-Y 2 +X 8", encoded_line() + encoded_line())),
              std::vector(16, kColor));
}

TEST(DecodeHdr, FlatAndEncodedLinesInOneFile) {
    std::string flat;
    for (int i = 0; i < 8; ++i) flat += kPixel;
    EXPECT_EQ(pixels_of(radiance_file("-Y 2 +X 8", flat + encoded_line())),
              std::vector(16, kColor));
}

TEST(DecodeHdr, RunLengthLinesOfTheOldKind) {
    // Repeats of the pixel before: 2, and 3 + 256.
    const std::string two("\1\1\1\2", 4), lowest("\1\1\1\3", 4), next("\1\1\1\1", 4);
    const std::string other("\x80\x80\x80\x81", 4);  // 0.5 * 2
    EXPECT_EQ(pixels_of(radiance_file("-Y 1 +X 4", kPixel + two + other)),
              (std::vector{kColor, kColor, kColor, glm::vec3(1.0f)}));
    EXPECT_EQ(pixels_of(radiance_file("-Y 1 +X 261", kPixel + lowest + next + other)), [] {
        std::vector pixels(261, kColor);
        pixels.back() = glm::vec3(1.0f);
        return pixels;
    }());
}

TEST(DecodeHdr, TheHeaderMayHaveOtherLines) {
    const std::string variables = "# a comment\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\nVIEW= -vtv\n";
    EXPECT_EQ(pixels_of(radiance_file("-Y 1 +X 1", kPixel, variables)), std::vector{kColor});
    EXPECT_EQ(pixels_of(radiance_file("-Y 1 +X 1", kPixel, "")), std::vector{kColor});
}

TEST(DecodeHdr, RefusesEveryTruncation) {
    for (const std::string& whole :
         {radiance_file("-Y 2 +X 8", encoded_line() + encoded_line()),
          radiance_file("-Y 2 +X 2", kPixel + kPixel + kPixel + std::string("\1\1\1\1", 4))}) {
        ASSERT_TRUE(detail::decode_hdr(bytes_of(whole)));
        for (size_t length = 0; length < whole.size(); ++length) {
            EXPECT_FALSE(detail::decode_hdr(bytes_of(whole).first(length))) << length;
        }
    }
}

TEST(DecodeHdr, RefusesRunsBeyondTheirLine) {
    const std::string start("\x02\x02\x00\x08", 4), rest(100, '\x81');
    const std::string problem = "cannot decode image (scan line 0 of 1 is cut off or damaged)";
    for (const std::string& line :
         {start + '\x89' + rest, start + '\x09' + rest, start + '\0' + rest, start + '\x80' + rest,
          std::string("\x02\x02\x00\x09", 4) + rest,     // another width
          std::string("\1\1\1\1", 4) + rest,             // repeats nothing
          kPixel + std::string("\1\1\1\x08", 4) + rest,  // 8 after 1 of 8
          kPixel + std::string("\1\1\1\0\1\1\1\0\1\1\1\0\1\1\1\0\1\1\1\0", 20) + rest}) {
        EXPECT_EQ(error_of(radiance_file("-Y 1 +X 8", line)), problem);
    }
}

TEST(DecodeHdr, SaysWhatIsNotSupported) {
    EXPECT_EQ(error_of(radiance_file("-Y 1 +X 1", kPixel, "FORMAT=32-bit_rle_xyze\n")),
              "colours as XYZ (FORMAT=32-bit_rle_xyze) are not supported, only RGB");
    EXPECT_EQ(error_of(radiance_file("-Y 1 +X 1", kPixel, "FORMAT=other\n")),
              "FORMAT is not 32-bit_rle_rgbe");
    for (const std::string orientation : {"+Y 1 +X 1", "-Y 1 -X 1", "+X 1 -Y 1"}) {
        EXPECT_NE(error_of(radiance_file(orientation, kPixel)).find("is not supported, only -Y +X"),
                  std::string::npos);
    }
}

TEST(DecodeHdr, RefusesWrongResolutions) {
    for (const std::string size : {"", "-Y 1", "-Y 1 +X", "-Y 1 +X 1 2", "-Y 1 +X 1x", "-Y -1 +X 1",
                                   "-Y 1 +Z 1", "-Y 0 +X 1", "-Y 1 +X 99999999999999999999"}) {
        EXPECT_FALSE(detail::decode_hdr(bytes_of(radiance_file(size, kPixel)))) << size;
    }
}

TEST(DecodeHdr, RefusesLargeImagesOfFewBytes) {
    EXPECT_EQ(error_of(radiance_file("-Y 100000 +X 100000", "")),
              "100000 x 100000 pixels are more than the largest size (268435456 pixels)");
    EXPECT_EQ(error_of(radiance_file("-Y 16384 +X 16384", kPixel)),
              "cannot decode image (scan line 1 of 16384 is cut off or damaged)");
}

TEST(ReadHdrSize, NeedsTheHeaderAlone) {
    const std::string file = radiance_file("-Y 20 +X 30", "");
    const auto size = detail::read_hdr_size(bytes_of(file));
    ASSERT_TRUE(size);
    EXPECT_EQ(*size, (ImageSize{30, 20}));
    EXPECT_FALSE(detail::read_hdr_size(bytes_of(file).first(file.size() - 1)));
}

}  // namespace
}  // namespace tetralight
