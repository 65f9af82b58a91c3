// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <limits>

#include <tetralight/bake/image/detail/exr_header.h>
#include <tetralight/bake/image/read_image.h>
#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/error_text.h>
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// An uncompressed EXR file of 2 x 1 half floats with one channel, written byte by byte: the
/// layout is that of "OpenEXR File Layout".
std::string one_channel_exr(char channel, const std::array<uint16_t, 2>& halves) {
    const auto u32 = [](uint32_t value) {
        return std::string(reinterpret_cast<const char*>(&value), 4);
    };
    const auto attribute = [&](const char* name, const char* type, const std::string& value) {
        return std::string(name) + '\0' + type + '\0' + u32(static_cast<uint32_t>(value.size())) +
               value;
    };
    const std::string box = u32(0) + u32(0) + u32(1) + u32(0);
    const std::string one = u32(0x3f800000u);
    const std::string channels =
        std::string(1, channel) + '\0' + u32(1) + u32(0) + u32(1) + u32(1) + '\0';
    std::string file = u32(20000630u) + u32(2);
    file += attribute("channels", "chlist", channels);
    file += attribute("compression", "compression", std::string(1, '\0'));
    file += attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box);
    file += attribute("lineOrder", "lineOrder", std::string(1, '\0'));
    file += attribute("pixelAspectRatio", "float", one);
    file += attribute("screenWindowCenter", "v2f", u32(0) + u32(0));
    file += attribute("screenWindowWidth", "float", one) + '\0';
    file += u32(static_cast<uint32_t>(file.size() + 8)) + u32(0);  // offset of the one scan line
    file += u32(0) + u32(4) + std::string(reinterpret_cast<const char*>(halves.data()), 4);
    return file;
}

constexpr uint16_t kHalfOne = 0x3c00;
constexpr uint16_t kHalfTwo = 0x4000;

TEST(ReadExr, TakesLuminanceAloneAsGrey) {
    const TempFolder folder;
    const auto path = folder.write("y.exr", one_channel_exr('Y', {kHalfOne, kHalfTwo}));
    const auto image = read_hdr_image(path);
    ASSERT_TRUE(image) << error_text(image.error());
    EXPECT_EQ(image->image.pixels, (std::vector{glm::vec3(1.0f), glm::vec3(2.0f)}));
}

TEST(ReadExr, NamesTheChannelThatIsMissing) {
    const TempFolder folder;
    const auto path = folder.write("r.exr", one_channel_exr('R', {kHalfOne, kHalfTwo}));
    const auto image = read_hdr_image(path);
    ASSERT_FALSE(image);
    EXPECT_EQ(error_text(image.error()), path + ": has no channel G");
}

TEST(ReadExr, RejectsAWindowThatIsTooLarge) {
    const TempFolder folder;
    std::string file = one_channel_exr('Y', {kHalfOne, kHalfTwo});
    const size_t box = file.find("dataWindow") + sizeof("dataWindow") + sizeof("box2i") + 4;
    const uint32_t last[] = {100000 - 1, 100000 - 1};
    file.replace(box + 8, 8, std::string(reinterpret_cast<const char*>(last), 8));
    const auto image = read_hdr_image(folder.write("large.exr", file));
    ASSERT_FALSE(image);
    EXPECT_NE(error_text(image.error()).find("large.exr"), std::string::npos);
}

TEST(ReadExrSize, NeedsTheHeaderAlone) {
    const std::string file = one_channel_exr('Y', {kHalfOne, kHalfTwo});
    constexpr size_t kBehindHeader = 8 + 4 + 4 + 4;  // offsets, the scan line and its pixels
    const auto header = std::as_bytes(std::span(file)).first(file.size() - kBehindHeader);
    const auto size = detail::read_exr_size(header);
    ASSERT_TRUE(size) << error_text(size.error());
    EXPECT_EQ(*size, (ImageSize{2, 1}));
    for (size_t length = 0; length < header.size(); ++length) {
        EXPECT_FALSE(detail::read_exr_size(header.first(length))) << length;
    }
}

TEST(ReadExrSize, RefusesAnAttributeThatIsLargerThanTheFile) {
    std::string file = one_channel_exr('Y', {kHalfOne, kHalfTwo});
    const size_t length = file.find("compression") + 2 * sizeof("compression");
    file.replace(length, 4, "\xff\xff\xff\x7f");
    const auto size = detail::read_exr_size(std::as_bytes(std::span(file)));
    ASSERT_FALSE(size);
    EXPECT_EQ(error_text(size.error()), "cannot decode image (the header is cut off or damaged)");
}

TEST(ReadExr, RejectsEveryTruncation) {
    const TempFolder folder;
    ASSERT_TRUE(write_exr(folder.path("whole.exr"), ImageF{4, 4, std::vector<glm::vec3>(16)}));
    const auto whole = *read_file(folder.path("whole.exr"));
    for (size_t length = 0; length < whole.size(); ++length) {
        const auto path = folder.write("cut.exr", std::span(whole).first(length));
        const auto image = read_hdr_image(path);
        ASSERT_FALSE(image) << length;
        EXPECT_TRUE(error_text(image.error()).starts_with(path)) << error_text(image.error());
    }
}

TEST(ReadExr, BadTexelsAreMendedAndCounted) {
    const TempFolder folder;
    const ImageF image{
        5,
        1,
        {{kNan, 1, 1}, {1, -3, -4}, {kInfinity, 2, -kInfinity}, {1, 2, 3}, {3e38f, 1e30f, 1}}};
    ASSERT_TRUE(write_exr(folder.path("bad.exr"), image));
    const auto read = read_hdr_image(folder.path("bad.exr"));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->mended_pixel_count, 4u);
    const std::vector<glm::vec3> mended = {
        {0, 1, 1}, {1, 0, 0}, {65504, 2, 0}, {1, 2, 3}, {1e30f, 1e30f, 1}};
    EXPECT_EQ(read->image.pixels, mended);
}

}  // namespace
}  // namespace tetralight
