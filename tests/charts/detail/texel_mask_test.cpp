// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/texel_mask.h>

#include <gtest/gtest.h>

#include <random>

namespace tetralight::detail {
namespace {

bool has(const TexelMask& mask, int x, int y) {
    if (x < 0 || y < 0 || x >= int(mask.width) || y >= int(mask.height)) return false;
    const auto column = static_cast<uint32_t>(x), row = static_cast<uint32_t>(y);
    return (mask.words[row * mask.words_per_row + column / 64] >> column % 64 & 1) != 0;
}

TexelMask random_mask(std::mt19937& random, uint32_t width, uint32_t height) {
    TexelMask mask = make_texel_mask(width, height);
    for (int i = 0; i < 20; ++i) {
        const auto y = static_cast<uint32_t>(random() % height);
        const auto begin = static_cast<uint32_t>(random() % width);
        const auto length = static_cast<uint32_t>(random() % (width - begin) + 1);
        add_span(mask, y, begin, begin + (i % 2 ? length : 1));
    }
    return mask;
}

TEST(TexelMask, SpansSetTheirTexelsOnly) {
    for (const auto& [begin, end] : {std::pair(0u, 1u),
                                     {63u, 64u},
                                     {63u, 65u},
                                     {5u, 200u},
                                     {64u, 128u},
                                     {0u, 200u},
                                     {199u, 200u}}) {
        TexelMask mask = make_texel_mask(200, 3);
        add_span(mask, 1, begin, end);
        EXPECT_EQ(texel_count(mask), end - begin);
        EXPECT_TRUE(has(mask, int(begin), 1));
        EXPECT_TRUE(has(mask, int(end) - 1, 1));
    }
}

TEST(TexelMask, DilationAddsTheEightNeighbors) {
    std::mt19937 random(1);
    for (const uint32_t width : {1u, 3u, 63u, 64u, 65u, 130u}) {
        const TexelMask mask = random_mask(random, width, 20);
        const TexelMask dilated = dilate_mask(mask);
        for (int y = 0; y < 20; ++y) {
            for (int x = 0; x < int(width); ++x) {
                bool is_near = false;
                for (int i = 0; i < 9; ++i) is_near |= has(mask, x + i % 3 - 1, y + i / 3 - 1);
                ASSERT_EQ(has(dilated, x, y), is_near) << width << ": " << x << ", " << y;
            }
        }
        EXPECT_EQ(dilate_mask(dilated).words.size(), mask.words.size());
    }
}

TEST(TexelMask, DilationSetsNoBitsPastTheWidth) {
    TexelMask mask = make_texel_mask(10, 1);
    add_span(mask, 0, 0, 10);
    EXPECT_EQ(dilate_mask(mask), mask);
}

TEST(TexelMask, BlocksHaveEachTexelOnce) {
    std::mt19937 random(2);
    const TexelMask mask = random_mask(random, 150, 30);
    TexelMask from_blocks = make_texel_mask(150, 30);
    uint64_t count = 0;
    for (const MaskBlock& block : mask_blocks(mask)) {
        for (const uint32_t row : block.rows) {
            add_span(from_blocks, row, block.begin, block.begin + block.length);
            count += block.length;
        }
    }
    EXPECT_EQ(from_blocks, mask);
    EXPECT_EQ(count, texel_count(mask));
}

}  // namespace
}  // namespace tetralight::detail
