// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/draw_text.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace tetralight {
namespace {

using Pixel = std::array<uint8_t, 4>;

constexpr Pixel kGround = {1, 2, 3, 255};

/// The picture as text: '#' for letters, 'o' for their outline.
std::vector<std::string> drawn(uint32_t width, uint32_t height, float x, float y,
                               std::string_view text) {
    Image8 image{width, height, std::vector<Pixel>(size_t{width} * height, kGround)};
    draw_text(image, x, y, text);
    std::vector<std::string> lines(height);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const Pixel& pixel = image.pixels[i];
        lines[i / width] += pixel == kGround ? '.' : pixel[0] == 255 ? '#' : 'o';
    }
    return lines;
}

TEST(DrawText, AFullStopIsASquareInAnOutline) {
    // It stands on the line, 14 pixels below the corner.
    const std::vector<std::string> expected = {"oooo..", "o##o..", "o##o..", "oooo.."};
    EXPECT_EQ(drawn(6, 4, 1, -11, "."), expected);
}

TEST(DrawText, LettersStandSideBySideAndLinesOneUponAnother) {
    const auto one = drawn(60, 60, 2, 2, "T"), two = drawn(60, 60, 2, 2, "TT");
    const auto lines = drawn(60, 60, 2, 2, "T\nT");
    const auto count = [](const std::vector<std::string>& picture) {
        std::string all;
        for (const std::string& line : picture) all += line;
        return std::ranges::count(all, '#');
    };
    EXPECT_GT(count(one), 0);
    EXPECT_EQ(count(two), 2 * count(one));
    EXPECT_EQ(count(lines), 2 * count(one));
    EXPECT_EQ(lines[24 + 2], one[2]);  // two pixels for each of 12
}

TEST(DrawText, TextOutsideOfTheImageIsClipped) {
    EXPECT_EQ(drawn(4, 4, -1000, 0, "text"), drawn(4, 4, 0, 0, ""));
    EXPECT_EQ(drawn(4, 4, 0, 1000, "text"), drawn(4, 4, 0, 0, ""));
}

TEST(DrawText, OtherCharactersAreQuestionMarks) {
    EXPECT_EQ(drawn(60, 30, 2, 2, "\xc3\xa9"), drawn(60, 30, 2, 2, "??"));
}

}  // namespace
}  // namespace tetralight
