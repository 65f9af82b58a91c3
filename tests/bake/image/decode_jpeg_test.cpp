// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/decode_jpeg.h>

#include <gtest/gtest.h>

#include <string>

#include <tetralight/base/error_text.h>
#include "tests/support/image_files.h"

namespace tetralight {
namespace {

using test::adobe_segment;
using test::constant_jpeg;
using test::JpegOptions;
using Pixel = std::array<uint8_t, 4>;

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

/// The colour of an image that has only one.
Pixel color_of(const std::string& file, uint32_t size = 8) {
    const auto image = detail::decode_jpeg(bytes_of(file));
    if (!image) {
        ADD_FAILURE() << error_text(image.error());
        return {};
    }
    EXPECT_EQ(*image,
              (Image8{size, size, std::vector<Pixel>(size_t{size} * size, image->pixels[0])}));
    return image->pixels[0];
}

TEST(DecodeJpeg, GreyIsExact) {
    for (const uint8_t value : std::vector<uint8_t>{0, 1, 127, 128, 129, 200, 255}) {
        EXPECT_EQ(color_of(constant_jpeg({value})), (Pixel{value, value, value, 255}));
    }
}

TEST(DecodeJpeg, ConvertsYCbCr) {
    // By JFIF: R = Y + 1.402 (Cr - 128), G = Y - 0.344136 (Cb - 128) - 0.714136 (Cr - 128),
    // B = Y + 1.772 (Cb - 128).
    EXPECT_EQ(color_of(constant_jpeg({100, 128, 128})), (Pixel{100, 100, 100, 255}));
    EXPECT_EQ(color_of(constant_jpeg({100, 148, 138})), (Pixel{114, 86, 135, 255}));
    EXPECT_EQ(color_of(constant_jpeg({100, 28, 228})), (Pixel{240, 63, 0, 255}));
}

TEST(DecodeJpeg, UpsamplesColors) {
    EXPECT_EQ(color_of(constant_jpeg({100, 148, 138}, {.sampling = 2}), 16),
              (Pixel{114, 86, 135, 255}));
}

TEST(DecodeJpeg, DecodesProgressiveFiles) {
    EXPECT_EQ(color_of(constant_jpeg({100, 148, 138}, {.is_progressive = true})),
              (Pixel{114, 86, 135, 255}));
}

TEST(DecodeJpeg, RgbIsNotConverted) {
    const Pixel expected = {10, 20, 230, 255};
    EXPECT_EQ(color_of(constant_jpeg({10, 20, 230}, {.ids = "RGB"})), expected);
    EXPECT_EQ(color_of(constant_jpeg({10, 20, 230}, {.markers = adobe_segment(0)})), expected);
}

TEST(DecodeJpeg, CmykOfAdobeIsInverted) {
    // 200 * 100 / 255 = 78.4, 100 * 100 / 255 = 39.2, 255 * 100 / 255 = 100
    EXPECT_EQ(color_of(constant_jpeg({200, 100, 255, 100}, {.markers = adobe_segment(0)})),
              (Pixel{78, 39, 100, 255}));
    // YCCK: R, G, B = 114, 86, 135 as above are 255 - C, 255 - M, 255 - Y: C = 141, M = 169, Y =
    // 120.
    EXPECT_EQ(color_of(constant_jpeg({100, 148, 138, 255}, {.markers = adobe_segment(2)})),
              (Pixel{141, 169, 120, 255}));
    EXPECT_EQ(color_of(constant_jpeg({100, 148, 138, 100}, {.markers = adobe_segment(2)})),
              (Pixel{55, 66, 47, 255}));
}

TEST(DecodeJpeg, AFourthChannelWithoutAdobesMarkerIsNotUsed) {
    EXPECT_EQ(color_of(constant_jpeg({100, 148, 138, 7})), (Pixel{114, 86, 135, 255}));
}

TEST(DecodeJpeg, RefusesEveryTruncation) {
    for (const bool is_progressive : {false, true}) {
        const std::string whole =
            constant_jpeg({100, 148, 138}, {.is_progressive = is_progressive});
        for (size_t length = 0; length < whole.size(); ++length) {
            const auto image = detail::decode_jpeg(bytes_of(whole).first(length));
            ASSERT_FALSE(image) << length;
            EXPECT_TRUE(error_text(image.error()).starts_with("cannot decode image ("))
                << error_text(image.error());
        }
    }
}

TEST(DecodeJpeg, BytesBehindAnImageChangeNothing) {
    EXPECT_EQ(color_of(constant_jpeg({50}) + "more"), (Pixel{50, 50, 50, 255}));
}

/// The file with other bytes in place of a part of it.
std::string replaced(std::string file, std::string_view part, std::string_view other) {
    const size_t place = file.find(part);
    EXPECT_NE(place, std::string::npos);
    return file.replace(place, part.size(), other);
}

TEST(DecodeJpeg, RefusesWrongHuffmanTables) {
    const std::string whole = constant_jpeg({50});
    const auto with_counts = [&](const std::string& sixteen) {
        const size_t place = whole.find("\xff\xc4");
        std::string file = whole;
        return file.replace(place + 5, 16, sixteen);
    };
    const std::string many = std::string(14, '\0') + "\xff\xff";
    EXPECT_FALSE(detail::decode_jpeg(bytes_of(with_counts(many)))) << "510 codes";
    const std::string short_ones = "\3" + std::string(2, '\0') + '\x09' + std::string(12, '\0');
    EXPECT_FALSE(detail::decode_jpeg(bytes_of(with_counts(short_ones)))) << "3 codes of one bit";
    // A table that says it has 4080 codes, and nothing else.
    const std::string table = "\xff\xd8\xff\xc4" + test::big_endian(0xffff, 2) + '\0' +
                              std::string(16, '\xff') + std::string(10, '\x01');
    EXPECT_FALSE(detail::decode_jpeg(bytes_of(table)));
}

TEST(DecodeJpeg, RefusesDamagedData) {
    const std::string whole = constant_jpeg({50});
    // The tables have no code of four ones.
    const size_t data = whole.size() - 4;
    std::string damaged = whole;
    damaged.replace(data, 2, std::string("\xf5\x55", 2));
    EXPECT_FALSE(detail::decode_jpeg(bytes_of(damaged)));
    EXPECT_FALSE(detail::decode_jpeg(bytes_of(replaced(whole, "\xff\xdb", "\xff\xfe"))))
        << "no quantization";
    EXPECT_FALSE(detail::decode_jpeg(bytes_of(replaced(whole, "\x08\x00\x08", "\x0c\x00\x08"))))
        << "12 bits";
}

TEST(DecodeJpeg, RefusesManyScans) {
    // A progressive file whose one scan is repeated: the first scan of a coefficient comes again.
    const std::string whole = constant_jpeg({50}, {.is_progressive = true});
    const size_t begin = whole.rfind("\xff\xda");
    const std::string scan = whole.substr(begin, whole.size() - 2 - begin);
    std::string file = whole.substr(0, begin);
    for (int i = 0; i < 600; ++i) file += scan;
    EXPECT_FALSE(detail::decode_jpeg(bytes_of(file + "\xff\xd9")));
}

TEST(ReadJpegSize, NeedsNoPixels) {
    const std::string whole = constant_jpeg({50});
    std::string file = whole;
    const size_t frame = file.find("\xff\xc0");
    file.replace(frame + 5, 4, test::big_endian(200, 2) + test::big_endian(300, 2));
    const size_t scan_end = whole.size() - 4;
    const auto size = detail::read_jpeg_size(bytes_of(file).first(scan_end));
    ASSERT_TRUE(size) << error_text(size.error());
    EXPECT_EQ(*size, (ImageSize{300, 200}));
}

TEST(ReadJpegSize, RefusesASizeAboveTheLimit) {
    std::string file = constant_jpeg({50});
    const size_t frame = file.find("\xff\xc0");
    file.replace(frame + 5, 4, test::big_endian(20000, 2) + test::big_endian(20000, 2));
    const auto size = detail::read_jpeg_size(bytes_of(file));
    ASSERT_FALSE(size);
    EXPECT_EQ(error_text(size.error()),
              "20000 x 20000 pixels are more than the largest size (268435456 pixels)");
    EXPECT_FALSE(detail::decode_jpeg(bytes_of(file)));
}

}  // namespace
}  // namespace tetralight
