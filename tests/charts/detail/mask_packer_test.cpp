// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/mask_packer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <set>

namespace tetralight::detail {
namespace {

using Texels = std::set<std::pair<uint32_t, uint32_t>>;

/// A mask of a triangle or a frame.
TexelMask random_shape(std::mt19937& random) {
    const auto width = static_cast<uint32_t>(random() % 30 + 1);
    const auto height = static_cast<uint32_t>(random() % 12 + 1);
    TexelMask mask = make_texel_mask(width, height);
    const bool is_frame = random() % 2 == 0;
    for (uint32_t y = 0; y < height; ++y) {
        add_span(mask, y, 0, is_frame ? 1 : 1 + (width - 1) * (y + 1) / height);
        if (is_frame) add_span(mask, y, width - 1, width);
    }
    add_span(mask, height - 1, 0, width);
    return mask;
}

Texels texels_at(const TexelMask& mask, MaskPacker::Place place) {
    Texels texels;
    for (const MaskBlock& block : mask_blocks(mask)) {
        for (const uint32_t row : block.rows) {
            for (uint32_t x = block.begin; x < block.begin + block.length; ++x) {
                texels.insert({place.x + x, place.y + row});
            }
        }
    }
    return texels;
}

bool is_free(const Texels& taken, const Texels& texels) {
    return std::ranges::none_of(texels, [&](const auto& texel) { return taken.contains(texel); });
}

/// The first free place by trying each, row by row.
std::optional<std::pair<uint32_t, uint32_t>> first_by_trying(const Texels& taken,
                                                             const TexelMask& mask, uint32_t width,
                                                             uint32_t height) {
    for (uint32_t y = 0; y + mask.height <= height; ++y) {
        for (uint32_t x = 0; x + mask.width <= width; ++x) {
            if (is_free(taken, texels_at(mask, {x, y}))) return std::pair(x, y);
        }
    }
    return std::nullopt;
}

TEST(MaskPacker, FindsTheFirstFreePlace) {
    std::mt19937 random(1);
    for (const uint32_t width : {31u, 64u, 90u}) {
        MaskPacker packer(width, 40);
        Texels taken;
        for (int i = 0; i < 25; ++i) {
            const TexelMask mask = random_shape(random);
            const MaskShape shape = make_mask_shape(mask);
            const auto place = packer.find_place(shape, 0);
            const auto expected = first_by_trying(taken, mask, width, 40);
            ASSERT_EQ(place.has_value(), expected.has_value()) << i;
            if (!place) continue;
            ASSERT_EQ(std::pair(place->x, place->y), *expected) << i;
            packer.place(shape, *place);
            taken.merge(texels_at(mask, *place));
        }
    }
}

TEST(MaskPacker, StartsAtTheGivenRow) {
    TexelMask mask = make_texel_mask(2, 1);
    add_span(mask, 0, 0, 2);
    MaskPacker packer(10, 10);
    EXPECT_EQ(packer.find_place(make_mask_shape(mask), 7)->y, 7u);
    EXPECT_FALSE(packer.find_place(make_mask_shape(mask), 10));
}

TEST(MaskPacker, RefusesWhatIsWiderOrHigherThanTheStrip) {
    TexelMask mask = make_texel_mask(11, 3);
    add_span(mask, 1, 0, 11);
    EXPECT_FALSE(MaskPacker(10, 10).find_place(make_mask_shape(mask), 0));
    EXPECT_FALSE(MaskPacker(20, 2).find_place(make_mask_shape(mask), 0));
    EXPECT_TRUE(MaskPacker(11, 3).find_place(make_mask_shape(mask), 0));
}

TEST(MaskPacker, KnowsWhatItUses) {
    TexelMask mask = make_texel_mask(4, 3);
    add_span(mask, 0, 0, 4);
    const MaskShape shape = make_mask_shape(mask);
    MaskPacker packer(10, 10);
    packer.place(shape, *packer.find_place(shape, 5));
    EXPECT_EQ(packer.used_width(), 4u);
    EXPECT_EQ(packer.used_height(), 8u);
}

}  // namespace
}  // namespace tetralight::detail
