// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/ktx2.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

TEST(Ktx2, PairsArePaddedToFourBytes) {
    std::string pairs;
    append_ktx2_pair(pairs, "key", std::string_view("a\0", 2));
    EXPECT_EQ(pairs, std::string("\6\0\0\0key\0a\0\0\0", 12));
    append_ktx2_pair(pairs, "k", "12");
    EXPECT_EQ(pairs.substr(12), std::string("\4\0\0\0k\0"
                                            "12",
                                            8));
}

TEST(Ktx2, DescribesFloatsOfEverySize) {
    for (const uint32_t bytes : {8u, 16u}) {
        const Ktx2Descriptor descriptor = make_ktx2_descriptor(bytes);
        EXPECT_EQ(descriptor.plane_bytes[0], bytes);
        for (size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(descriptor.samples[i].bit_offset, i * bytes * 2);
            EXPECT_EQ(descriptor.samples[i].bit_length + 1u, bytes * 2);
        }
        EXPECT_EQ(descriptor.samples[3].channel, 0xc0 | 15);  // alpha; float, signed
    }
}

}  // namespace
}  // namespace tetralight
