// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/pack_pages.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace tetralight {
namespace {

using Sizes = std::vector<TexelSize>;

Sizes random_sizes(uint32_t seed, size_t count, uint32_t largest) {
    std::mt19937 random(seed);
    Sizes sizes(count);
    for (TexelSize& size : sizes) {
        size.width = static_cast<uint32_t>(random() % largest + 1);
        size.height = static_cast<uint32_t>(random() % largest + 1);
    }
    return sizes;
}

uint32_t page_count(const std::vector<PagePlace>& places) {
    uint32_t count = 0;
    for (const PagePlace& place : places) count = std::max(count, place.page + 1);
    return count;
}

/// Checks that rectangles lie in their pages and do not overlap: each texel is filled at most once.
void expect_disjoint(const Sizes& sizes, const std::vector<PagePlace>& places, uint32_t page_size) {
    ASSERT_EQ(places.size(), sizes.size());
    const size_t page_texels = size_t{page_size} * page_size;
    std::vector<bool> is_filled(page_count(places) * page_texels);
    for (size_t i = 0; i < sizes.size(); ++i) {
        const auto [page, left, low] = places[i];
        ASSERT_LE(left + sizes[i].width, page_size);
        ASSERT_LE(low + sizes[i].height, page_size);
        for (uint32_t y = low; y < low + sizes[i].height; ++y) {
            for (uint32_t x = left; x < left + sizes[i].width; ++x) {
                const size_t texel = page * page_texels + size_t{y} * page_size + x;
                ASSERT_FALSE(is_filled[texel]) << "rectangle " << i;
                is_filled[texel] = true;
            }
        }
    }
}

TEST(PackPages, NoRectanglesNeedNoPlaces) {
    EXPECT_TRUE(pack_pages({}, 64)->empty());
}

TEST(PackPages, ARectangleOfAPageFillsIt) {
    EXPECT_EQ(*pack_pages(Sizes{{64, 64}}, 64), (std::vector<PagePlace>{{0, 0, 0}}));
    EXPECT_EQ(page_count(*pack_pages(Sizes{{64, 64}, {1, 1}}, 64)), 2u);
}

TEST(PackPages, EmptyRectanglesTakeNoPlace) {
    const auto places = pack_pages(Sizes{{64, 64}, {0, 0}, {0, 500}, {7, 0}}, 64);
    EXPECT_EQ(*places, std::vector<PagePlace>(4));
}

TEST(PackPages, FourQuartersShareAPage) {
    EXPECT_EQ(page_count(*pack_pages(Sizes(4, {32, 32}), 64)), 1u);
    EXPECT_EQ(page_count(*pack_pages(Sizes(5, {32, 32}), 64)), 2u);
}

TEST(PackPages, RandomRectanglesDoNotOverlap) {
    for (uint32_t seed = 0; seed < 50; ++seed) {
        const Sizes sizes = random_sizes(seed, 1 + 10 * seed, 1 + 2 * seed % 64);
        expect_disjoint(sizes, *pack_pages(sizes, 64), 64);
    }
}

TEST(PackPages, LeavesLittleOfThePagesEmpty) {
    const Sizes sizes = random_sizes(1, 2000, 120);
    const auto places = pack_pages(sizes, 1024);
    expect_disjoint(sizes, *places, 1024);
    double texels = 0.0;
    for (const TexelSize& size : sizes) texels += 1.0 * size.width * size.height;
    // All but the last page are 90 % full.
    EXPECT_LE(page_count(*places), 1.0 + texels / (0.9 * 1024 * 1024));
}

TEST(PackPages, TenThousandEqualRectanglesLeaveNothingEmpty) {
    // 100 × 100 fit into a page of 1000, one more does not.
    Sizes sizes(10'000, {10, 10});
    const auto places = pack_pages(sizes, 1000);
    EXPECT_EQ(page_count(*places), 1u);
    expect_disjoint(sizes, *places, 1000);
    sizes.push_back({10, 10});
    EXPECT_EQ(page_count(*pack_pages(sizes, 1000)), 2u);
}

TEST(PackPages, TenThousandRandomRectanglesDoNotOverlap) {
    const Sizes sizes = random_sizes(9, 10'000, 40);
    expect_disjoint(sizes, *pack_pages(sizes, 1024), 1024);
}

TEST(PackPages, NamesTheRectangleThatIsLargerThanAPage) {
    const auto places = pack_pages(Sizes{{5, 5}, {3, 65}}, 64);
    ASSERT_FALSE(places);
    EXPECT_EQ(places.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(places.error().field, "rectangles[1]");
    EXPECT_EQ(places.error().value, "3 × 65");
}

TEST(PackPages, GivesTheSameResultTwice) {
    const Sizes sizes = random_sizes(4, 500, 50);
    EXPECT_EQ(*pack_pages(sizes, 256), *pack_pages(sizes, 256));
}

}  // namespace
}  // namespace tetralight
