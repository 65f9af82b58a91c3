// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/smallest_rectangle.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tetralight::detail {
namespace {

/// Angle of a side modulo a right angle, in [0, 90).
double angle_degrees(glm::dvec2 side) {
    const double angle = std::atan2(side.y, side.x) * 180.0 / std::numbers::pi + 360.0;
    return std::fmod(angle + 1e-9, 90.0);
}

TEST(SmallestRectangle, FindsTheAngleOfATurnedRectangle) {
    for (const double degrees : {0.0, 10.0, 45.0, 80.0}) {
        const double angle = degrees * std::numbers::pi / 180.0;
        const glm::dvec2 u(std::cos(angle), std::sin(angle)), v(-u.y, u.x);
        std::vector<glm::dvec2> points;
        for (int i = 0; i <= 6; ++i) {
            for (int j = 0; j <= 3; ++j) points.push_back(double(i) * u + double(j) * v);
        }
        EXPECT_NEAR(angle_degrees(smallest_rectangle_side(points)), degrees, 1e-6);
    }
}

TEST(SmallestRectangle, ASquareOnTheAxesIsNotTurnedAtAll) {
    const glm::dvec2 side = smallest_rectangle_side({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
    EXPECT_EQ(std::abs(side.x) + std::abs(side.y), 1.0);
}

TEST(SmallestRectangle, ASegmentIsASide) {
    const glm::dvec2 side = smallest_rectangle_side({{1, 1}, {4, 5}, {2.5, 3}});
    EXPECT_NEAR(std::abs(side.x * 0.6 + side.y * 0.8), 1.0, 1e-15);
}

TEST(SmallestRectangle, APointHasTheFirstAxis) {
    EXPECT_EQ(smallest_rectangle_side({{1, 1}, {1, 1}}), glm::dvec2(1, 0));
}

}  // namespace
}  // namespace tetralight::detail
