// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/radiance_length.h>

#include <gtest/gtest.h>

#include <string>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/base/error_text.h>
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

/// Two lines of 8 pixels, run-length encoded: (128, 64, 32) / 256 * 2^(130 - 128) = (2, 1, 0.5).
std::string run_length_hdr() {
    const std::string literal_red("\x08\x80\x80\x80\x80\x80\x80\x80\x80", 9);
    const std::string runs("\x88\x40\x88\x20\x88\x82", 6);  // 136 = eight of the next byte
    const std::string line = std::string("\x02\x02\x00\x08", 4) + literal_red + runs;
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 8\n" + line + line;
}

TEST(RadianceLength, RunLengthLinesAreWhole) {
    const TempFolder folder;
    const auto read = read_hdr_image(folder.write("rle.hdr", run_length_hdr()));
    ASSERT_TRUE(read) << error_text(read.error());
    EXPECT_EQ(read->image.pixels, std::vector<glm::vec3>(16, glm::vec3(2.0f, 1.0f, 0.5f)));
}

TEST(RadianceLength, EveryTruncationIsFound) {
    const std::string whole = run_length_hdr();
    for (size_t length = 0; length < whole.size(); ++length) {
        const std::string cut = whole.substr(0, length);
        EXPECT_FALSE(detail::has_all_scan_lines(std::as_bytes(std::span(cut)), 8, 2)) << length;
    }
}

TEST(RadianceLength, EveryTruncatedFileIsAnError) {
    const TempFolder folder;
    const std::string whole = run_length_hdr();
    for (size_t length = 0; length < whole.size(); ++length) {
        EXPECT_FALSE(read_hdr_image(folder.write("cut.hdr", whole.substr(0, length)))) << length;
    }
}

}  // namespace
}  // namespace tetralight
