// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/fill_texels.h>

#include <gtest/gtest.h>

#include <string_view>

namespace tetralight {
namespace {

/// A map of rows of characters: letters are charts, capitals of them have light, dots are free.
struct Drawing {
    TexelMap map;
    std::vector<bool> has_light;

    Drawing(uint32_t width, std::string_view rows) {
        map.width = width;
        map.height = static_cast<uint32_t>(rows.size()) / width;
        for (uint32_t i = 0; i < rows.size(); ++i) {
            const char letter = rows[i];
            const bool is_capital = letter >= 'A' && letter <= 'Z';
            map.charts.push_back(letter == '.' ? kNoIndex
                                               : static_cast<uint32_t>(letter | 0x20) - 'a');
            if (letter == '.') continue;
            map.texels.push_back({i, 0, 0});
            has_light.push_back(is_capital);
        }
    }

    [[nodiscard]] std::vector<float> filled(std::vector<float> values) const {
        values.push_back(0.0f);
        make_texel_fill(map, has_light).apply(values);
        values.pop_back();
        return values;
    }
};

TEST(FillTexels, TexelsTakeTheMeanOfNeighborsOfTheirChart) {
    const Drawing drawing(3, "AaB");
    EXPECT_EQ(drawing.filled({2, 0, 8}), (std::vector<float>{2, 2, 8}));
    const Drawing between(3, "AaA");
    EXPECT_EQ(between.filled({2, 0, 8}), (std::vector<float>{2, 5, 8}));
}

TEST(FillTexels, LightSpreadsThroughAChart) {
    const Drawing drawing(5, "Aaaaa");
    EXPECT_EQ(drawing.filled({3, 0, 0, 0, 0}), (std::vector<float>{3, 3, 3, 3, 3}));
}

TEST(FillTexels, AChartWithoutLightTakesTheMeanOfTheRectangle) {
    const Drawing drawing(7, "A.C...b");
    const std::vector<float> filled = drawing.filled({2, 0, 6, 0, 0, 0, 0});
    EXPECT_EQ(filled[6], 4.0f);
}

TEST(FillTexels, FreeTexelsBesideChartsAreFilledOnce) {
    const Drawing drawing(5, "A...B");
    EXPECT_EQ(drawing.filled({2, 0, 0, 0, 8}), (std::vector<float>{2, 2, 0, 8, 8}));
}

TEST(FillTexels, WithoutAnyLightNothingIsFilled) {
    const Drawing drawing(2, "aa");
    EXPECT_TRUE(make_texel_fill(drawing.map, drawing.has_light).steps.empty());
}

TEST(FillTexels, SumsOfFilledValuesAreFilledSums) {
    const Drawing drawing(4, "AabBaaABcccc");
    const std::vector<float> a{1, 0, 0, 2, 0, 0, 3, 4, 0, 0, 0, 0};
    const std::vector<float> b{5, 0, 0, 7, 0, 0, 1, 2, 0, 0, 0, 0};
    std::vector<float> sum;
    for (size_t i = 0; i < a.size(); ++i) sum.push_back(a[i] + b[i]);
    const auto fa = drawing.filled(a), fb = drawing.filled(b), fs = drawing.filled(sum);
    for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(fa[i] + fb[i], fs[i], 1e-5f) << i;
}

}  // namespace
}  // namespace tetralight
