// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/chart_means.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace tetralight {
namespace {

constexpr int kSize = 40;  // two tiles

/// Two charts side by side, with 2 free columns between them. Texels have numbers row by row, those
/// of the first chart before those of the second.
class ChartMeans : public testing::Test {
  protected:
    ChartMeans() {
        const std::vector<uint32_t> chart(size_t{kSize} * kSize, 0);
        for (int i = 0; i < 2; ++i) pages.add(0, {i * (kSize + 2), 0}, kSize, chart);
        for (int i = 0; i < 2 * kSize * kSize; ++i) {
            const int second = i / (kSize * kSize), at = i % (kSize * kSize);
            pages.set_texel(0, {second * (kSize + 2) + at % kSize, at / kSize},
                            static_cast<uint32_t>(i));
            values.push_back(second * 100.0 + (at % 7) * 1.5 - at / 900.0);
        }
    }

    [[nodiscard]] static size_t number(int chart, int x, int y) {
        return static_cast<size_t>((chart * kSize + y) * kSize + x);
    }

    /// Of the texels from `low` to `high`, both included, of a chart.
    [[nodiscard]] double sum(int chart, glm::ivec2 low, glm::ivec2 high) const {
        double sum = 0.0;
        for (int y = std::max(0, low.y); y <= std::min(kSize - 1, high.y); ++y) {
            for (int x = std::max(0, low.x); x <= std::min(kSize - 1, high.x); ++x)
                sum += values[number(chart, x, y)];
        }
        return sum;
    }

    PageCharts pages{2 * kSize + 2, 1};
    std::vector<double> values;
};

TEST_F(ChartMeans, AreThoseOfSquaresWithinAChart) {
    const auto means = chart_means(pages, values, 2, 0);
    EXPECT_NEAR(means[number(0, 20, 31)], sum(0, {18, 29}, {22, 33}) / 25.0, 1e-9);
    EXPECT_NEAR(means[number(0, 0, 0)], sum(0, {0, 0}, {2, 2}) / 9.0, 1e-9);
    EXPECT_NEAR(means[number(0, 39, 5)], sum(0, {37, 3}, {39, 7}) / 15.0, 1e-9);
}

TEST_F(ChartMeans, ContinueAcrossSeams) {
    const float size = kSize;
    const std::vector<Seam> seams{
        {{0, {size, 0}, {size, size}}, {0, {size + 2, 0}, {size + 2, size}}}};
    pages.add_seams(seams);
    const auto means = chart_means(pages, values, 2, 0);
    const double both = sum(0, {38, 3}, {39, 7}) + sum(1, {0, 3}, {2, 7});
    EXPECT_NEAR(means[number(1, 0, 5)], both / 25.0, 1e-9);
}

TEST_F(ChartMeans, TheSameForAnyNumberOfThreads) {
    EXPECT_EQ(chart_means(pages, values, 3, 1), chart_means(pages, values, 3, 3));
}

}  // namespace
}  // namespace tetralight
