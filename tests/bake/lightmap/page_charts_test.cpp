// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/page_charts.h>

#include <gtest/gtest.h>

#include <vector>

namespace tetralight {
namespace {

/// Two charts of 4 × 4 texels in one rectangle of 10 × 4, two free columns between them. A texel's
/// number is ten times its row plus its column.
class TwoCharts : public testing::Test {
  protected:
    TwoCharts() {
        std::vector<uint32_t> charts;
        for (int y = 0; y < 4; ++y) {
            for (int x = 0; x < 10; ++x) charts.push_back(x < 4 ? 7u : x < 6 ? kNoIndex : 3u);
        }
        pages.add(0, {1, 2}, 10, charts);
        for (int y = 0; y < 4; ++y) {
            for (int x = 0; x < 10; ++x) {
                if (x >= 4 && x < 6) continue;
                pages.set_texel(0, {1 + x, 2 + y}, static_cast<uint32_t>(10 * y + x));
            }
        }
    }

    /// A row of texels around a chart.
    [[nodiscard]] std::vector<uint32_t> row(uint32_t chart, glm::ivec2 low, int count) const {
        std::vector<uint32_t> texels(static_cast<size_t>(count));
        pages.copy_texels(chart, low, {count, 1}, texels);
        return texels;
    }

    PageCharts pages{16, 1};
};

TEST_F(TwoCharts, AreKnownByTheirBounds) {
    ASSERT_EQ(pages.charts().size(), 2u);
    EXPECT_EQ(pages.charts()[0].low, glm::ivec2(1, 2));
    EXPECT_EQ(pages.charts()[0].high, glm::ivec2(5, 6));
    EXPECT_EQ(pages.charts()[1].low, glm::ivec2(7, 2));
    EXPECT_EQ(pages.charts()[1].high, glm::ivec2(11, 6));
}

TEST_F(TwoCharts, EndAtTheirBordersWithoutASeam) {
    EXPECT_EQ(row(0, {0, 3}, 8),
              (std::vector<uint32_t>{kNoIndex, 10, 11, 12, 13, kNoIndex, kNoIndex, kNoIndex}));
    EXPECT_EQ(pages.texel_of(0, {7, 3}), kNoIndex);  // of the other chart
    EXPECT_EQ(pages.texel_of(1, {7, 3}), 16u);
}

TEST_F(TwoCharts, GoOnAcrossASeam) {
    // The right side of the first chart is the left side of the second.
    const std::vector<Seam> seams{{{0, {5, 2}, {5, 6}}, {0, {7, 2}, {7, 6}}}};
    pages.add_seams(seams);
    EXPECT_EQ(row(0, {1, 3}, 8), (std::vector<uint32_t>{10, 11, 12, 13, 16, 17, 18, 19}));
    EXPECT_EQ(row(1, {3, 5}, 8), (std::vector<uint32_t>{30, 31, 32, 33, 36, 37, 38, 39}));
    EXPECT_EQ(row(0, {1, 7}, 4), std::vector<uint32_t>(4, kNoIndex));  // beyond the end of the seam
}

TEST_F(TwoCharts, TurnAtASeam) {
    // The right side of the first chart, from row 0 on, is the lower side of the second, from right
    // to left: a step to the right becomes a step to row 0, 1, …
    const std::vector<Seam> seams{{{0, {5, 2}, {5, 6}}, {0, {11, 2}, {7, 2}}}};
    pages.add_seams(seams);
    EXPECT_EQ(row(0, {3, 2}, 6), (std::vector<uint32_t>{2, 3, 9, 19, 29, 39}));
    EXPECT_EQ(row(0, {3, 5}, 6), (std::vector<uint32_t>{32, 33, 6, 16, 26, 36}));
}

TEST_F(TwoCharts, SeamsToTexelsOfAnotherSizeAreScaled) {
    // Four texels on one side are two on the other.
    const std::vector<Seam> seams{{{0, {5, 2}, {5, 6}}, {0, {7, 3}, {7, 5}}}};
    pages.add_seams(seams);
    EXPECT_EQ(row(0, {4, 2}, 5), (std::vector<uint32_t>{3, 16, 16, 17, 17}));
    EXPECT_EQ(row(0, {4, 5}, 5), (std::vector<uint32_t>{33, 26, 26, 27, 27}));
}

TEST(PageCharts, SeamsBesideNarrowChartsAreLeftOut) {
    PageCharts pages(16, 1);
    const std::vector<uint32_t> one(4, 0);
    pages.add(0, {1, 1}, 1, one);
    pages.add(0, {5, 1}, 1, one);
    for (int y = 1; y < 5; ++y) {
        pages.set_texel(0, {1, y}, 1);
        pages.set_texel(0, {5, y}, 2);
    }
    const std::vector<Seam> seams{{{0, {1.5f, 1}, {1.5f, 5}}, {0, {5.5f, 1}, {5.5f, 5}}}};
    pages.add_seams(seams);
    std::vector<uint32_t> texels(3);
    pages.copy_texels(0, {0, 2}, {3, 1}, texels);
    EXPECT_EQ(texels, (std::vector<uint32_t>{kNoIndex, 1, kNoIndex}));
}

}  // namespace
}  // namespace tetralight
