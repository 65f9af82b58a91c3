// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/hex.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

TEST(Hex, WritesNumbersWithLeadingZeros) {
    EXPECT_EQ(hex(0), "0000000000000000");
    EXPECT_EQ(hex(0xdeadbeef), "00000000deadbeef");
    EXPECT_EQ(hex(~uint64_t{0}), "ffffffffffffffff");
    EXPECT_EQ(hex(0x1a2, 4), "01a2");
}

TEST(Hex, WritesTwoDigitsAByte) {
    const std::byte bytes[] = {std::byte{0x00}, std::byte{0x7f}, std::byte{0xa0}};
    EXPECT_EQ(hex(bytes), "007fa0");
    EXPECT_EQ(hex(std::span<const std::byte>()), "");
}

}  // namespace
}  // namespace tetralight
