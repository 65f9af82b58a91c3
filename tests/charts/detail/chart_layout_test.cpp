// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/chart_layout.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/charts/chart_oracle.h"

namespace tetralight::detail {
namespace {

/// Counterclockwise triangles of sizes from 2^-8 to 2^4.
FlatTriangle random_triangle(std::mt19937& random) {
    const auto next = [&] { return static_cast<double>(random() % 4096) / 4096.0; };
    const double size = std::ldexp(1.0, static_cast<int>(random() % 13) - 8);
    const glm::dvec2 origin(20.0 * next() - 10.0, 20.0 * next() - 10.0);
    FlatTriangle triangle;
    do {
        for (glm::dvec2& corner : triangle) {
            const double x = next();
            corner = origin + size * glm::dvec2(x, next());
        }
    } while (signed_area(triangle) <= 1e-3 * size * size);
    return triangle;
}

TEST(ChartLayout, AddsWhatOverlapsNothing) {
    std::mt19937 random(1);
    ChartLayout layout;
    for (int round = 0; round < 3; ++round) {
        std::vector<FlatTriangle> added;
        for (int i = 0; i < 2000; ++i) {
            const FlatTriangle triangle = random_triangle(random);
            const bool is_free = std::ranges::none_of(
                added, [&](const FlatTriangle& other) { return overlap(triangle, other); });
            ASSERT_EQ(layout.try_add(triangle), is_free) << i;
            if (is_free) added.push_back(triangle);
        }
        layout.clear();
    }
}

TEST(ChartLayout, TakesTrianglesOfVeryDifferentSizes) {
    ChartLayout layout;
    EXPECT_TRUE(layout.try_add({{{0, 0}, {1e-3, 0}, {0, 1e-3}}}));
    EXPECT_TRUE(layout.try_add({{{0, 0}, {-1e3, 0}, {0, -1e3}}}));
    EXPECT_FALSE(layout.try_add({{{-1, -1}, {1e4, -1}, {-1, 1e4}}}));
    EXPECT_TRUE(layout.try_add({{{1, 0}, {1e4, 0}, {1, 1e4}}}));
}

}  // namespace
}  // namespace tetralight::detail
