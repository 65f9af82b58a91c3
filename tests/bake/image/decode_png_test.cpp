// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/decode_png.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include <tetralight/base/error_text.h>
#include "tests/support/image_files.h"

namespace tetralight {
namespace {

using test::png_chunk;
using test::png_file;
using test::PngHeader;

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

uint32_t channel_count(uint8_t color_type) {
    constexpr uint32_t kCounts[] = {1, 0, 3, 1, 2, 0, 4};
    return kCounts[color_type];
}

/// Some value of a channel of a pixel, as the file stores it.
uint32_t sample(const PngHeader& header, uint32_t x, uint32_t y, uint32_t channel) {
    const uint32_t mixed = (x * 7919u + y * 104729u + channel * 1299709u + 17u) * 2654435761u;
    return mixed >> (32 - header.bit_depth);
}

constexpr uint32_t kStep[7][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                  {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};

/// The bytes of one line of pixels, which begin at x and are `step` apart.
std::string pack_line(const PngHeader& header, uint32_t x, uint32_t step, uint32_t y) {
    std::string line;
    uint32_t bits = 0, bit_count = 0;
    for (; x < header.width; x += step) {
        for (uint32_t channel = 0; channel < channel_count(header.color_type); ++channel) {
            bits = bits << header.bit_depth | sample(header, x, y, channel);
            for (bit_count += header.bit_depth; bit_count >= 8; bit_count -= 8) {
                line += static_cast<char>(bits >> (bit_count - 8));
            }
        }
    }
    if (bit_count > 0) line += static_cast<char>(bits << (8 - bit_count));
    return line;
}

/// Chapter 9 of the PNG specification: a is to the left, b above, c above a.
int predict(uint32_t filter, int a, int b, int c) {
    const int p = a + b - c;
    const int pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
    const int paeth = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
    const int predictions[] = {0, a, b, (a + b) / 2, paeth};
    return predictions[filter];
}

std::string filter_line(const PngHeader& header, const std::string& line, const std::string& above,
                        uint32_t filter) {
    const size_t pixel = std::max(1u, channel_count(header.color_type) * header.bit_depth / 8u);
    const auto at = [](const std::string& bytes, size_t i, size_t back) {
        return i < back || i - back >= bytes.size() ? 0 : static_cast<uint8_t>(bytes[i - back]);
    };
    std::string filtered(1, static_cast<char>(filter));
    for (size_t i = 0; i < line.size(); ++i) {
        const int prediction =
            predict(filter, at(line, i, pixel), at(above, i, 0), at(above, i, pixel));
        filtered += static_cast<char>(static_cast<uint8_t>(line[i]) - prediction);
    }
    return filtered;
}

/// The lines of all passes, with each filter in turn.
std::string scan_lines(const PngHeader& header) {
    std::string lines;
    uint32_t filter = 0;
    for (uint32_t pass = 0; pass < (header.interlace != 0 ? 7u : 1u); ++pass) {
        const uint32_t whole[] = {0, 0, 1, 1};
        const uint32_t* step = header.interlace != 0 ? kStep[pass] : whole;
        std::string above;
        for (uint32_t y = step[1]; y < header.height && step[0] < header.width; y += step[3]) {
            const std::string line = pack_line(header, step[0], step[2], y);
            lines += filter_line(header, line, above, filter++ % 5);
            above = line;
        }
    }
    return lines;
}

std::array<uint8_t, 3> palette_color(uint32_t index) {
    return {static_cast<uint8_t>(index * 37 + 5), static_cast<uint8_t>(255 - index),
            static_cast<uint8_t>(index ^ 0x55)};
}

uint8_t palette_alpha(uint32_t index) {
    return static_cast<uint8_t>(index * 91 + 3);
}

/// Chunks of a palette of all indices, whose first half has alpha.
std::string palette_chunks(const PngHeader& header) {
    std::string colors, alphas;
    for (uint32_t i = 0; i < 1u << header.bit_depth; ++i) {
        for (const uint8_t channel : palette_color(i)) colors += static_cast<char>(channel);
        if (i < 1u << (header.bit_depth - 1)) alphas += static_cast<char>(palette_alpha(i));
    }
    return png_chunk("PLTE", colors) + png_chunk("tRNS", alphas);
}

/// The pixel that the specification gives, with the upper 8 bits of 16.
std::array<uint8_t, 4> expected_pixel(const PngHeader& header, uint32_t x, uint32_t y) {
    const auto byte = [&](uint32_t channel) {
        const uint32_t value = sample(header, x, y, channel);
        const uint32_t largest = (1u << header.bit_depth) - 1;
        return static_cast<uint8_t>(header.bit_depth == 16 ? value >> 8 : value * 255 / largest);
    };
    switch (header.color_type) {
        case 0:
            return {byte(0), byte(0), byte(0), 255};
        case 2:
            return {byte(0), byte(1), byte(2), 255};
        case 3: {
            const uint32_t index = sample(header, x, y, 0);
            const auto color = palette_color(index);
            const bool has_alpha = index < 1u << (header.bit_depth - 1);
            return {color[0], color[1], color[2], has_alpha ? palette_alpha(index) : uint8_t{255}};
        }
        case 4:
            return {byte(0), byte(0), byte(0), byte(1)};
        default:
            return {byte(0), byte(1), byte(2), byte(3)};
    }
}

Image8 expected_image(const PngHeader& header) {
    Image8 image{header.width, header.height, {}};
    for (uint32_t y = 0; y < header.height; ++y) {
        for (uint32_t x = 0; x < header.width; ++x) {
            image.pixels.push_back(expected_pixel(header, x, y));
        }
    }
    return image;
}

std::string file_of(const PngHeader& header) {
    return png_file(header, scan_lines(header),
                    header.color_type == 3 ? palette_chunks(header) : "");
}

struct Kind {
    uint8_t color_type;
    std::vector<uint8_t> bit_depths;
};

TEST(DecodePng, AllKindsHaveThePixelsOfTheSpecification) {
    const Kind kinds[] = {
        {0, {1, 2, 4, 8, 16}}, {2, {8, 16}}, {3, {1, 2, 4, 8}}, {4, {8, 16}}, {6, {8, 16}}};
    for (const Kind& kind : kinds) {
        for (const uint8_t depth : kind.bit_depths) {
            for (const bool is_interlaced : {false, true}) {
                for (const uint32_t width : {1u, 5u, 19u}) {
                    const PngHeader header{width, 11, depth, kind.color_type,
                                           static_cast<uint8_t>(is_interlaced)};
                    const auto image = detail::decode_png(bytes_of(file_of(header)));
                    ASSERT_TRUE(image) << error_text(image.error());
                    EXPECT_EQ(*image, expected_image(header))
                        << "type " << int{kind.color_type} << " depth " << int{depth}
                        << " interlaced " << is_interlaced << " width " << width;
                }
            }
        }
    }
}

/// The alpha of two grey or RGB pixels, where a colour stands for transparent ones.
std::vector<int> alphas_of(const PngHeader& header, std::string_view line, std::string_view color) {
    const std::string file = png_file(header, line, png_chunk("tRNS", color));
    const auto image = detail::decode_png(bytes_of(file));
    EXPECT_TRUE(image);
    std::vector<int> alphas;
    for (const auto& pixel : image->pixels) alphas.push_back(pixel[3]);
    return alphas;
}

TEST(DecodePng, OneColorStandsForTransparentPixels) {
    using namespace std::string_view_literals;
    EXPECT_EQ(alphas_of({2, 1, 8, 0}, "\0\x07\x08"sv, "\0\x08"sv), (std::vector{255, 0}));
    EXPECT_EQ(alphas_of({2, 1, 4, 0}, "\0\x5a"sv, "\0\x05"sv), (std::vector{0, 255}));
    EXPECT_EQ(alphas_of({2, 1, 8, 2}, "\0\1\2\3\1\2\4"sv, "\0\1\0\2\0\3"sv), (std::vector{0, 255}));
    // All 16 bits count, although 8 are kept.
    EXPECT_EQ(alphas_of({2, 1, 16, 0}, "\0\1\2\1\3"sv, "\1\3"sv), (std::vector{255, 0}));
}

TEST(DecodePng, OfATransparentColorTheBitsOfTheDepthCount) {
    using namespace std::string_view_literals;
    EXPECT_EQ(alphas_of({2, 1, 8, 0}, "\0\x07\x08"sv, "\x01\x08"sv), (std::vector{255, 0}));
    EXPECT_EQ(alphas_of({2, 1, 8, 2}, "\0\1\2\3\1\2\4"sv, "\xff\1\0\2\0\3"sv),
              (std::vector{0, 255}));
}

TEST(DecodePng, ColorSpacesAndDamageBesideThePixelsChangeNothing) {
    const std::string line("\0\x80", 2);
    const Image8 gray{1, 1, {{0x80, 0x80, 0x80, 255}}};
    std::string wrong_checksum = png_chunk("gAMA", test::big_endian(45455, 4));
    wrong_checksum.back() ^= 1;
    for (const std::string& chunks :
         {png_chunk("gAMA", test::big_endian(100000, 4)), png_chunk("gAMA", "short"),
          png_chunk("iCCP", "no profile"), png_chunk("zTXt", std::string("k\0\0no zlib", 10)),
          png_chunk("abCd", "unknown"), wrong_checksum}) {
        const std::string file = png_file({}, line, chunks);
        const auto image = detail::decode_png(bytes_of(file));
        ASSERT_TRUE(image) << error_text(image.error());
        EXPECT_EQ(*image, gray);
    }
}

TEST(DecodePng, RefusesWhatIsWrong) {
    const std::string line("\0\x80", 2);
    std::string wrong_checksum = png_file({}, line);
    wrong_checksum[wrong_checksum.find("IDAT") + 5] ^= 1;
    const std::pair<const char*, std::string> files[] = {
        {"no pixels", png_file({0, 1}, "")},
        {"too few pixels", png_file({2, 2}, line)},
        {"filter 5", png_file({}, "\5\1")},
        {"depth 3", png_file({1, 1, 3, 0}, line)},
        {"colour type 5", png_file({1, 1, 8, 5}, line)},
        {"interlace 2", png_file({1, 1, 8, 0, 2}, line)},
        {"no palette", png_file({1, 1, 8, 3}, line)},
        {"palette of 4 bytes", png_file({1, 1, 8, 3}, line, png_chunk("PLTE", "abcd"))},
        {"unknown critical chunk", png_file({}, line, png_chunk("ABCD", ""))},
        {"wrong checksum", wrong_checksum},
    };
    for (const auto& [what, file] : files) {
        EXPECT_FALSE(detail::decode_png(bytes_of(file))) << what;
    }
}

TEST(DecodePng, RefusesEveryTruncation) {
    const PngHeader header{5, 4, 4, 3, 1};
    const std::string whole = file_of(header);
    for (size_t length = 0; length < whole.size() - 4; ++length) {  // the last 4 are a checksum
        const auto image = detail::decode_png(bytes_of(whole).first(length));
        ASSERT_FALSE(image) << length;
    }
}

TEST(ReadPngSize, NeedsTheHeaderAlone) {
    const std::string file = png_file({300, 200, 8, 6}, "");
    constexpr size_t kHeaderEnd = 33, kChecksum = 4;
    const auto size = detail::read_png_size(bytes_of(file).first(kHeaderEnd));
    ASSERT_TRUE(size) << error_text(size.error());
    EXPECT_EQ(*size, (ImageSize{300, 200}));
    EXPECT_FALSE(detail::read_png_size(bytes_of(file).first(kHeaderEnd - kChecksum - 1)));
}

}  // namespace
}  // namespace tetralight
