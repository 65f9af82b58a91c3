// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/decode_webp.h>

#include <gtest/gtest.h>
#include <webp/encode.h>

#include <cstdlib>
#include <string>

#include <tetralight/base/error_text.h>
#include "tests/support/image_files.h"

namespace tetralight {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

/// Every pixel differs, and none is wholly transparent: encoders may change the colour of such.
Image8 many_colors(uint32_t width, uint32_t height) {
    Image8 image{width, height, {}};
    for (uint32_t i = 0; i < width * height; ++i) {
        image.pixels.push_back({static_cast<uint8_t>(i * 7), static_cast<uint8_t>(i * 31),
                                static_cast<uint8_t>(255 - i), static_cast<uint8_t>(1 + i % 255)});
    }
    return image;
}

std::string file_of(uint8_t* bytes, size_t size) {
    std::string file(reinterpret_cast<const char*>(bytes), size);
    WebPFree(bytes);
    return file;
}

std::string lossless_file(const Image8& image) {
    uint8_t* bytes = nullptr;
    const int width = static_cast<int>(image.width);
    const size_t size = WebPEncodeLosslessRGBA(image.pixels[0].data(), width,
                                               static_cast<int>(image.height), 4 * width, &bytes);
    return file_of(bytes, size);
}

std::string lossy_file(const Image8& image) {
    uint8_t* bytes = nullptr;
    const int width = static_cast<int>(image.width);
    const size_t size = WebPEncodeRGBA(image.pixels[0].data(), width,
                                       static_cast<int>(image.height), 4 * width, 100.0f, &bytes);
    return file_of(bytes, size);
}

TEST(DecodeWebp, LosslessPixelsComeBack) {
    const Image8 image = many_colors(13, 9);
    const auto decoded = detail::decode_webp(bytes_of(lossless_file(image)));
    ASSERT_TRUE(decoded) << error_text(decoded.error());
    EXPECT_EQ(*decoded, image);
}

TEST(DecodeWebp, LossyPixelsComeBackNearlyAndTheirAlphaExactly) {
    const Image8 image{16, 16, std::vector<std::array<uint8_t, 4>>(256, {200, 100, 50, 77})};
    const auto decoded = detail::decode_webp(bytes_of(lossy_file(image)));
    ASSERT_TRUE(decoded) << error_text(decoded.error());
    ASSERT_EQ(decoded->pixels.size(), 256u);
    for (const auto& pixel : decoded->pixels) {
        EXPECT_NEAR(pixel[0], 200, 4);
        EXPECT_NEAR(pixel[1], 100, 4);
        EXPECT_NEAR(pixel[2], 50, 4);
        EXPECT_EQ(pixel[3], 77);
    }
}

TEST(DecodeWebp, OpaqueImagesHaveAlpha255) {
    const Image8 image{2, 1, {{1, 2, 3, 255}, {4, 5, 6, 255}}};
    const auto decoded = detail::decode_webp(bytes_of(lossless_file(image)));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(*decoded, image);
}

TEST(DecodeWebp, RefusesEveryTruncation) {
    for (const std::string& whole :
         {lossless_file(many_colors(7, 5)), lossy_file(many_colors(7, 5))}) {
        // The last byte of a file of odd size is a zero that fills it up.
        for (size_t length = 0; length + 1 < whole.size(); ++length) {
            const auto image = detail::decode_webp(bytes_of(whole).first(length));
            ASSERT_FALSE(image) << length << " of " << whole.size();
            EXPECT_TRUE(error_text(image.error()).starts_with("cannot decode image ("));
        }
    }
}

/// A file with an extended header, as the container specification of WebP has it.
std::string extended_file(uint8_t flags, uint32_t width, uint32_t height) {
    const std::string content = std::string(1, static_cast<char>(flags)) + std::string(3, '\0') +
                                test::little_endian(width - 1, 3) +
                                test::little_endian(height - 1, 3);
    const std::string chunk = "VP8X" + test::little_endian(10, 4) + content;
    return "RIFF" + test::little_endian(4 + 18, 4) + "WEBP" + chunk;
}

TEST(DecodeWebp, RefusesAnimations) {
    constexpr uint8_t kAnimation = 2;
    const auto image = detail::decode_webp(bytes_of(extended_file(kAnimation, 8, 8)));
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().code, ErrorCode::Unsupported);
    EXPECT_EQ(error_text(image.error()), "animated WebP images are not supported");
}

TEST(ReadWebpSize, NeedsTheHeaderAlone) {
    const std::string file = lossless_file(many_colors(13, 9));
    const auto size = detail::read_webp_size(bytes_of(file).first(30));
    ASSERT_TRUE(size) << error_text(size.error());
    EXPECT_EQ(*size, (ImageSize{13, 9}));
}

}  // namespace
}  // namespace tetralight
