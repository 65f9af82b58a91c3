// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/rasterize_texels.h>

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace tetralight {
namespace {

using Corners = std::array<glm::vec2, 3>;
using Texels = std::set<std::pair<int, int>>;

Texels touched(const Corners& triangle, float margin) {
    Texels texels;
    for_each_touched_texel(triangle, margin, [&](int x, int y) {
        EXPECT_TRUE(texels.insert({x, y}).second) << "visited twice: " << x << ", " << y;
    });
    return texels;
}

/// Least and largest dot product of points with a direction.
std::pair<double, double> extent_along(glm::dvec2 direction, std::span<const glm::dvec2> points) {
    std::pair<double, double> extent(INFINITY, -INFINITY);
    for (const glm::dvec2 p : points) {
        const double d = direction.x * p.x + direction.y * p.y;
        extent = {std::min(extent.first, d), std::max(extent.second, d)};
    }
    return extent;
}

/// Separating axis test of a triangle, which may be degenerate, and a square.
bool touches(const Corners& triangle, double x, double y, double margin) {
    const std::vector<glm::dvec2> corners(triangle.begin(), triangle.end());
    const double left = x - margin, right = x + 1 + margin, low = y - margin, high = y + 1 + margin;
    const std::vector<glm::dvec2> square{{left, low}, {right, low}, {right, high}, {left, high}};
    std::vector<glm::dvec2> axes{{1, 0}, {0, 1}};
    for (size_t k = 0; k < 3; ++k) {
        const glm::dvec2 edge = corners[(k + 1) % 3] - corners[k];
        axes.push_back({-edge.y, edge.x});
        axes.push_back(edge);  // separates the ends of segments
    }
    for (const glm::dvec2 axis : axes) {
        const auto [a, b] = extent_along(axis, corners);
        const auto [c, d] = extent_along(axis, square);
        if (b < c || d < a) return false;
    }
    return true;
}

Texels touched_by_trying(const Corners& triangle, float margin) {
    Texels texels;
    for (int y = -12; y < 12; ++y) {
        for (int x = -12; x < 12; ++x) {
            if (touches(triangle, x, y, margin)) texels.insert({x, y});
        }
    }
    return texels;
}

/// Corners in [-8, 8] in steps of 1 / `steps`.
Corners random_corners(std::mt19937& random, int steps) {
    const auto next = [&] {
        const int range = 16 * steps + 1;
        const int step = static_cast<int>(random() % static_cast<uint32_t>(range)) - 8 * steps;
        return static_cast<float>(step) / static_cast<float>(steps);
    };
    Corners corners;
    for (glm::vec2& corner : corners) {
        corner.x = next();
        corner.y = next();
    }
    return corners;
}

TEST(RasterizeTexels, APointTouchesTheTexelsAroundIt) {
    const glm::vec2 inside(2.25f, 3.75f), corner(2.0f, 3.0f);
    EXPECT_EQ(touched({inside, inside, inside}, 0.0f), (Texels{{2, 3}}));
    EXPECT_EQ(touched({inside, inside, inside}, 0.5f), (Texels{{1, 3}, {2, 3}, {1, 4}, {2, 4}}));
    EXPECT_EQ(touched({corner, corner, corner}, 0.0f), (Texels{{1, 2}, {2, 2}, {1, 3}, {2, 3}}));
}

TEST(RasterizeTexels, BordersCount) {
    const glm::vec2 middle(0.5f, 0.5f);
    // Half a texel around the texels on all sides ends in the middle of this one.
    EXPECT_EQ(touched({middle, middle, middle}, 0.5f).size(), 9u);
}

TEST(RasterizeTexels, ASlantedTriangleLeavesOutTheCornerOfItsBounds) {
    const Texels texels = touched({glm::vec2(0.5f, 0.5f), {7.5f, 0.5f}, {0.5f, 7.5f}}, 0.0f);
    EXPECT_FALSE(texels.contains({7, 7}));
    EXPECT_FALSE(texels.contains({5, 4}));
    // x + y = 8 is the slanted edge; the least corner of texel (4, 4) lies on it.
    EXPECT_TRUE(texels.contains({4, 4}));
}

TEST(RasterizeTexels, AgreesWithTheSeparatingAxisTest) {
    std::mt19937 random(1);
    for (int i = 0; i < 2000; ++i) {
        const Corners corners = random_corners(random, 64);
        for (const float margin : {0.0f, 0.5f, 1.25f}) {
            ASSERT_EQ(touched(corners, margin), touched_by_trying(corners, margin)) << i;
        }
    }
}

TEST(RasterizeTexels, AgreesForSegmentsAndPoints) {
    std::mt19937 random(2);
    for (int i = 0; i < 2000; ++i) {
        Corners corners = random_corners(random, 2);
        corners[2] = 0.5f * (corners[0] + corners[1]);
        if (i % 2 == 0) corners[2] = corners[i % 4 / 2];
        ASSERT_EQ(touched(corners, 0.5f), touched_by_trying(corners, 0.5f)) << i;
    }
}

}  // namespace
}  // namespace tetralight
