// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/flat_triangle.h>

#include <gtest/gtest.h>

#include <random>

#include "tests/charts/chart_oracle.h"

namespace tetralight::detail {
namespace {

constexpr FlatTriangle kHalfSquare{{{0, 0}, {1, 0}, {0, 1}}};

TEST(FlatTriangle, TrianglesThatShareAnEdgeDoNotOverlap) {
    EXPECT_FALSE(overlap(kHalfSquare, {{{1, 0}, {1, 1}, {0, 1}}}));
}

TEST(FlatTriangle, TrianglesThatShareACornerDoNotOverlap) {
    EXPECT_FALSE(overlap(kHalfSquare, {{{1, 0}, {2, 0}, {2, 1}}}));
}

TEST(FlatTriangle, ATriangleOverlapsItselfAndWhatItContains) {
    EXPECT_TRUE(overlap(kHalfSquare, kHalfSquare));
    EXPECT_TRUE(overlap(kHalfSquare, {{{0.1, 0.1}, {0.2, 0.1}, {0.1, 0.2}}}));
    EXPECT_TRUE(overlap({{{0.1, 0.1}, {0.2, 0.1}, {0.1, 0.2}}}, kHalfSquare));
}

TEST(FlatTriangle, RoundingOfACornerInAnEdgeIsNoOverlap) {
    EXPECT_FALSE(overlap(kHalfSquare, {{{0.5, 1e-7}, {0.0, -1.0}, {1.0, -1.0}}}));
    EXPECT_TRUE(overlap(kHalfSquare, {{{0.5, 1e-4}, {0.0, -1.0}, {1.0, -1.0}}}));
}

TEST(FlatTriangle, AgreesWithTheAreaThatTrianglesHaveInCommon) {
    std::mt19937 random(1);
    const auto next = [&] { return static_cast<double>(random() % 16); };
    for (int i = 0; i < 20'000; ++i) {
        std::array<FlatTriangle, 2> pair;
        for (FlatTriangle& triangle : pair) {
            for (glm::dvec2& corner : triangle) {
                corner.x = next();
                corner.y = next();
            }
            if (signed_area(triangle) < 0.0) std::swap(triangle[0], triangle[1]);
        }
        if (signed_area(pair[0]) == 0.0 || signed_area(pair[1]) == 0.0) continue;
        ASSERT_EQ(overlap(pair[0], pair[1]), common_area(pair[0], pair[1]) > 1e-9) << i;
    }
}

TEST(FlatTriangle, FramesAreRightHanded) {
    for (const glm::dvec3 axis : {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0),
                                  glm::dvec3(0.6, 0.0, -0.8), glm::dvec3(-0.48, 0.6, 0.64)}) {
        const PlaneFrame frame = make_plane_frame(axis);
        EXPECT_LT(glm::distance(glm::cross(frame.u, frame.v), axis), 1e-14);
        EXPECT_NEAR(glm::dot(frame.u, axis), 0.0, 1e-14);
    }
}

}  // namespace
}  // namespace tetralight::detail
